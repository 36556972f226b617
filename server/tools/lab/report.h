// What a measurement found: series of times, tables, plots, and the figures that must be reached. Printed, or written as JSON
// and SVG.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "tools/lab/plot.h"

namespace radiata::lab {

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

/// Text cells under headings; the first column is left-aligned, the others right-aligned.
struct Table {
    std::string title;
    std::vector<std::string> columns;
    std::vector<std::vector<std::string>> rows;
};

struct Report {
    std::string experiment, scene, view, device;
    int repeats = 0;
    std::vector<Series> series;
    std::vector<Table> tables;
    std::vector<Plot> plots;
    std::vector<Check> checks;
    std::vector<std::string> notes;
    /// What --check demands beside the figures themselves: the size, view and repeats asked for.
    std::vector<std::string> shortfalls;
};

/// Three significant digits, plain or with an exponent, whichever is shorter: "12.3", "0.00123", "1.2e-07"; "0" for zero.
std::string shortNumber(double value);

void print(const Report& report);
nlohmann::json toJson(const Report& report);

}  // namespace radiata::lab
