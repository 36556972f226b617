// Light through homogeneous media, in double, by adding up short pieces of the ray front to back. Twin of
// shaders/common/medium.glsl and of the pass before it; no exponential of a sum appears here.
// Source: Peters et al. 2023, Sec. 4.3.
#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "reference/sh_function.h"

namespace radiata::reference {

/// A glyph filled with a medium. Position and sizes in mm.
struct MediumGlyph {
    const ShFunction* function = nullptr;
    glm::dvec3 centre{0};
    double scale = 1;       ///< mm per unit of amplitude
    double extinction = 0;  ///< per mm
    glm::dvec3 emission{0};
};

/// Radiance towards the ray's beginning, of what leaves it at its end and of the media on the way.
/// \param steps  pieces; |error| is about extinction times length over steps for each crossing
glm::dvec3 throughMedia(const std::vector<MediumGlyph>& glyphs, const glm::dvec3& origin, const glm::dvec3& direction,
                        double begin, double end, bool both_lobes, const glm::dvec3& behind, int steps);

}  // namespace radiata::reference
