#include "cli/progress.h"

#include <iostream>

#include <unistd.h>

#include "common/table.h"

namespace radiata::client {

Progress::Progress(int total, bool quiet)
    : total_(total), quiet_(quiet), terminal_(::isatty(STDERR_FILENO) == 1), start_(std::chrono::steady_clock::now()) {}

Progress::~Progress() {
    if (open_line_) std::cerr << std::endl;
}

void Progress::step(int done, const std::string& what) {
    if (quiet_) return;
    const std::string count = std::to_string(done) + "/" + std::to_string(total_);
    if (!terminal_) {
        std::cerr << count << " " << what << std::endl;
        return;
    }
    constexpr int kWidth = 30;
    const int filled = kWidth * done / total_;
    const double elapsed_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    const double left_s = done > 0 ? elapsed_s / done * (total_ - done) : 0;
    // "\033[K" clears what a longer line before may have left.
    std::cerr << "\r[" << std::string(static_cast<std::size_t>(filled), '=')
              << std::string(static_cast<std::size_t>(kWidth - filled), ' ') << "] " << count << "  " << formatNumber(left_s, 0)
              << " s left  " << what << "\033[K" << std::flush;
    open_line_ = true;
}

}  // namespace radiata::client
