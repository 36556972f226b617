// Twin of shaders/common/colour_map.glsl.
#pragma once

#include <span>

#include <glm/glm.hpp>

namespace radiata::reference {

/// The colour of a value as the sum of all of the table's colours, each weighted by its hat function, which is 1 at its own
/// value and falls linearly to 0 at its neighbours'. \param low, high  of the table's first and last entry, low < high
glm::dvec3 mappedColour(std::span<const glm::vec3> table, double value, double low, double high);

}  // namespace radiata::reference
