// How far a ray travels inside of glyphs, in double. Twin of shaders/common/circle_inside.glsl and of the pass that adds it up:
// all hits by exhaustive search, and a test of a point between each two of them; nothing is marched and no state is carried.
// Source: Peters et al. 2023, Sec. 4.3.
#pragma once

#include <glm/glm.hpp>

#include "reference/sh_function.h"

namespace radiata::reference {

/// Whether a point is inside: |p| < f(p / |p|), or |f| with both lobes. \param p  relative to the glyph's centre, not zero
bool insideGlyph(const ShFunction& f, const glm::dvec3& p, bool both_lobes);

/// Length of the ray between parameters begin and end (finite) that is inside. \param origin, direction  as for glyphHits()
/// |error| < 1e-11 radii, and sqrt(1e-7) radii for a ray that touches without the search noticing.
double insideLength(const ShFunction& f, const glm::dvec3& origin, const glm::dvec3& direction, double begin, double end,
                    bool both_lobes);

}  // namespace radiata::reference
