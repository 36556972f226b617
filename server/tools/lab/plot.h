// Plots as data, and a small writer of SVG for them: logarithmic or linear axes, named points, Pareto front.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace radiata::lab {

struct PlotPoint {
    double x = 0, y = 0;
    std::string name;  ///< named points get a number in the plot and a line in the list under it
};

/// Points of one kind, one colour.
struct Curve {
    std::string name;
    std::vector<PlotPoint> points;
    bool line = false;  ///< joined by a line
};

struct Plot {
    std::string title, x_label, y_label;
    bool log_x = true, log_y = true;  ///< on a logarithmic axis zeros stand on a line of their own, at the low end
    bool front = false;               ///< draws the Pareto front: points that no other beats in both coordinates
    std::vector<Curve> curves;
};

/// Indices of the points that no other point beats: none is at most as large in both coordinates and smaller in one.
/// Ascending x; of equal points the first.
std::vector<std::size_t> paretoFront(const std::vector<PlotPoint>& points);

/// One picture with all plots, two side by side. \param heading  above them
std::string svg(const std::string& heading, const std::vector<Plot>& plots);

}  // namespace radiata::lab
