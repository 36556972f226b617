#include "reference/colour_map.h"

#include <algorithm>
#include <cmath>

namespace radiata::reference {

glm::dvec3 mappedColour(std::span<const glm::vec3> table, double value, double low, double high) {
    const double step = (high - low) / static_cast<double>(table.size() - 1);
    const double inside = value < low ? low : value > high ? high : value;
    glm::dvec3 sum(0);
    for (std::size_t i = 0; i < table.size(); ++i) {
        const double away = std::abs(inside - (low + step * static_cast<double>(i))) / step;
        sum += std::max(0.0, 1 - away) * glm::dvec3(table[i]);
    }
    return sum;
}

}  // namespace radiata::reference
