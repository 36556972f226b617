// What a measurement is: named, repeated, interleaved, and held against the figures it must reach.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "gpu/device.h"

namespace radiata::lab {

struct Options {
    int size = 0;       ///< picture height, pixels, or what the experiment says; 0: its own
    std::string image;  ///< SH image file; empty: a phantom
    int repeats = 9;
    std::vector<std::string> methods;  ///< only these; empty: all
};

/// One method's times of one setting, from one interleaved run.
struct Series {
    std::string name;
    std::string unit;
    std::vector<double> values;
    double median() const;
    double spread() const;  ///< (third quartile - first quartile) / median
    double minimum() const;
};

/// A figure that must be reached.
struct Check {
    std::string name;
    double value = 0;
    std::string relation;  ///< "<=" or ">="
    double bound = 0;
    bool holds() const { return relation == "<=" ? value <= bound : value >= bound; }
};

struct Report {
    std::string experiment, scene, view, device;
    int repeats = 0;
    std::vector<Series> series;
    std::vector<Check> checks;
    std::vector<std::string> notes;
    /// What --check demands beside the figures themselves: the size, view and repeats asked for.
    std::vector<std::string> shortfalls;
};

struct Experiment {
    std::string name;
    std::string about;
    std::function<Report(gpu::Device&, const Options&)> run;
};

/// All experiments, in the order of the documentation.
const std::vector<Experiment>& experiments();

Report glyphFrame(gpu::Device& device, const Options& options);
Report marchVersusPolynomial(gpu::Device& device, const Options& options);

/// Runs each measurement once to warm up, then `repeats` rounds of all in turn, so that drift of the machine meets all alike.
void interleave(int repeats, const std::vector<std::function<void()>>& measurements);

void print(const Report& report);
nlohmann::json toJson(const Report& report);

}  // namespace radiata::lab
