// From samples of a glyph to bounds that hold between them too; build/bounds.h has the proof.
#pragma once

#include "build/bounds.h"
#include "shaders/shared/glyph_bounds.glsl"

namespace radiata {

/// Samples in directions of a known covering radius, of coefficients that were divided by `scale`.
struct BoundsSamples {
    shader::GlyphExtremes extremes;
    double norm = 0;   ///< Euclidean norm of the coefficients that were sampled
    double scale = 0;  ///< of the glyph's own coefficients over those
};

/// \param covering_radius  tau, radians
/// Adds what float32 sums of `layout.count()` products, of coefficients and basis values that are each off by at most four
/// units in the last place, can err. Extents beyond float saturate.
GlyphBounds certifyBounds(ShLayout layout, double covering_radius, const BoundsSamples& samples, bool negative_lobes);

}  // namespace radiata
