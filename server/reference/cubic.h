// Roots of a trilinear cell's value along a chord, in double, by subdivision of the Bernstein form: no derivative, no iteration
// that could miss. Twin of shaders/common/cubic.glsl.
#pragma once

#include <array>
#include <optional>

#include <glm/glm.hpp>

namespace radiata::reference {

/// Value of a cell at p in [0, 1]^3. \param corners  x fastest, then y, then z
double cellValue(const std::array<double, 8>& corners, const glm::dvec3& p);

struct ChordRoot {
    double u = 0;  ///< in [0, 1]: where the value's sign first changes along the chord, within 1e-14
    /// How far the value goes beyond 0 on both sides of the root at least, over the whole chord; near 0 the root hangs on the
    /// rounding of the corners.
    double margin = 0;
};

/// The first place where the value along from + u (to - from), less `isovalue`, changes sign; 0 counts as positive.
std::optional<ChordRoot> firstChordRoot(const std::array<double, 8>& corners, double isovalue, const glm::dvec3& from,
                                        const glm::dvec3& to);

}  // namespace radiata::reference
