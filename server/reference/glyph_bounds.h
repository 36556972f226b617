// Exact extent of a glyph by brute force. Twin of the certified bounds in build.
// Source: Peters et al. 2023, Sec. 4.2 (samples on a spherical Fibonacci lattice, then refinement of the best); here every
// sample that could lead to the maximum is refined, so none is missed.
#pragma once

#include <glm/glm.hpp>

#include "reference/sh_function.h"

namespace radiata::reference {

struct GlyphBounds {
    double radius = 0;  ///< largest distance from the centre
    glm::dvec3 min{0}, max{0};
};

/// The box of the surface and of the centre, relative to the centre.
/// |error| < 1e-12 radii. Cost: some ten thousand evaluations of f for each of seven maxima.
GlyphBounds glyphBounds(const ShFunction& f, bool both_lobes);

}  // namespace radiata::reference
