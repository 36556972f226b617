#include "io/fiblet_page_file.h"

#include <fcntl.h>
#include <unistd.h>
#include <cerrno>
#include <cstring>
#include <utility>

#include "base/error.h"
#include "io/fiblet_layout.h"

namespace radiata::io {

FibletPageFile::FibletPageFile(const std::filesystem::path& path, const std::vector<shader::FibletPage>& pages,
                               std::vector<std::uint32_t> checks, std::uint64_t heads_offset, std::uint64_t codes_offset,
                               std::uint64_t words)
    : name_(path.filename().string()), checks_(std::move(checks)), heads_offset_(heads_offset), codes_offset_(codes_offset) {
    for (const shader::FibletPage& page : pages) {
        first_word_.push_back(page.first_word);
        counts_.push_back(page.count);
    }
    first_word_.push_back(words);
    file_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (file_ < 0) throw Error(Code::kUnavailable, name_ + ": cannot be opened (" + std::strerror(errno) + ")");
}

FibletPageFile::~FibletPageFile() { ::close(file_); }

void FibletPageFile::readAt(std::span<std::byte> out, std::uint64_t offset, std::uint32_t page) const {
    for (std::size_t done = 0; done < out.size();) {
        const ssize_t got = ::pread(file_, out.data() + done, out.size() - done, static_cast<off_t>(offset + done));
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) {
            throw Error(Code::kUnavailable, name_ + ": page " + std::to_string(page) + " cannot be read again (" +
                                                (got < 0 ? std::strerror(errno) : "the file was cut off") + ")");
        }
        done += static_cast<std::size_t>(got);
    }
}

void FibletPageFile::read(std::uint32_t first_page, std::uint32_t pages, std::span<model::FibletHead> heads,
                          std::span<std::uint32_t> codes) const {
    const std::uint64_t word = first_word_.at(first_page);
    readAt(std::as_writable_bytes(heads),
           heads_offset_ + std::uint64_t{first_page} * shader::FIBLET_PAGE * sizeof(model::FibletHead), first_page);
    readAt(std::as_writable_bytes(codes), codes_offset_ + 4 * word, first_page);
    std::size_t head = 0;
    for (std::uint32_t p = first_page; p < first_page + pages; ++p) {
        const auto own_heads = heads.subspan(head, counts_[p]);
        const auto own_codes = codes.subspan(first_word_[p] - word, first_word_.at(p + 1) - first_word_[p]);
        if (fiblet::crcOf(std::as_bytes(own_codes), fiblet::crcOf(std::as_bytes(own_heads))) != checks_[p]) {
            throw Error(Code::kCorrupt, name_ + ": page " + std::to_string(p) +
                                            " differs from its checksum; the file was changed while it was open");
        }
        head += counts_[p];
    }
}

}  // namespace radiata::io
