#include "tools/lab/experiment.h"

namespace radiata::lab {
namespace {

constexpr int kRepeatsWanted = 7;

}  // namespace

void interleave(int repeats, const std::vector<std::function<void()>>& measurements) {
    for (int round = 0; round < repeats; ++round) {
        for (const auto& measurement : measurements) measurement();
    }
}

int pictureHeight(const gpu::Device& device, const Options& options, int paper, int reduced) {
    if (options.size > 0) return options.size;
    return device.info().software ? reduced : paper;
}

void noteShortfalls(Report& report, int height, int height_wanted) {
    if (report.repeats < kRepeatsWanted) {
        report.shortfalls.push_back(std::to_string(report.repeats) + " repeats; " + std::to_string(kRepeatsWanted) +
                                    " are asked for");
    }
    if (height < height_wanted) {
        report.shortfalls.push_back("height " + std::to_string(height) + "; " + std::to_string(height_wanted) +
                                    " is asked for");
    }
}

}  // namespace radiata::lab
