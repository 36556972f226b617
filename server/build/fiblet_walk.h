// Points a constant step apart along a polyline: each lies on the line at the given distance, as the crow flies, from the one
// before.
#pragma once

#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace radiata {

struct Walk {
    std::vector<glm::vec3> points;  ///< first and last are the line's own; only the last step may be shorter
    std::vector<double> places;  ///< where on the line each lies: number of the vertex before plus the fraction of its segment
    double sum_error_mm = 0, max_error_mm = 0;  ///< distances of the line's vertices from the new line
};

/// Leaves the last point out if it coincides with the one before. No vertex is farther from the new line than one step.
void walk(std::span<const glm::vec3> line, double step_mm, Walk& out);

}  // namespace radiata
