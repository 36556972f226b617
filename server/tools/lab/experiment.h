// A named measurement, and what all of them share: options, interleaved repeats.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "gpu/device.h"
#include "tools/lab/report.h"

namespace radiata::lab {

struct Options {
    int size = 0;        ///< picture height, pixels, or what the experiment says; 0: its own
    std::string image;   ///< SH image file; empty: a phantom
    std::string tracts;  ///< tractogram file that the codec's experiments take too; empty: none
    int repeats = 0;     ///< 0: nine, or as few as seven where an experiment is long
    /// Rounds to run. \param usual  of this experiment
    int rounds(int usual = 9) const { return repeats > 0 ? repeats : usual; }
};

struct Experiment {
    std::string name;
    std::string about;
    std::function<Report(gpu::Device&, const Options&)> run;
};

/// All experiments, in the order of the documentation (experiments.cpp).
const std::vector<Experiment>& experiments();

/// Runs each measurement once to warm up, then `repeats` rounds of all in turn, so that drift of the machine meets all alike.
void interleave(int repeats, const std::vector<std::function<void()>>& measurements);

/// Height of the picture: what was asked for, else the paper's on a GPU and the reduced one on a CPU driver.
int pictureHeight(const gpu::Device& device, const Options& options, int paper, int reduced);

/// Notes what keeps a run from being the one that --check judges: fewer than seven repeats, a smaller picture.
void noteShortfalls(Report& report, int height, int height_wanted);

}  // namespace radiata::lab
