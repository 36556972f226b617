// Twin of shaders/common/fiblet_decode.glsl: bits taken from bytes, turns as angles, frames as three vectors that are turned by
// Rodrigues' formula.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace radiata::reference {

/// Points of a fiblet in double precision, mm from the set's origin.
/// \param head       the 20 bytes of the head, as five little-endian words
/// \param codes      words from the fiblet's first on
/// \param cap_ratio  1 - cos(cap) of the 16 caps
std::vector<glm::dvec3> fibletPoints(const std::array<std::uint32_t, 5>& head, std::span<const std::uint32_t> codes,
                                     double cell_mm, double step_mm, std::span<const float> cap_ratio);

}  // namespace radiata::reference
