// Certified bounds of spherical-harmonics glyphs: boxes and radii that never cut a glyph, a few per cent larger than it.
// Source: what is bounded is Peters et al. 2023, Sec. 4.2; in place of their empirical enlargement stands a guarantee:
//
// f has degree k on the sphere, h_a(d) = d_a f(d) has degree n = k + 1. On a great circle both are trigonometric polynomials of
// that degree, so Bernstein's and M. Riesz's inequalities hold. Samples d_i have covering radius tau: each direction has a
// sample within tau (for even layouts a sample or its antipode, on which |f| and |h_a| agree).
//  (1) p of degree n with max |p| = M at d0 satisfies |p(d)| >= M cos(n angle(d, d0)) (Riesz). Hence M <= max_i |p(d_i)| /
//  cos(n tau). (2) At a critical point d0 of p with value m, p(d) >= m - n^2 M tau^2 / 2 within tau (Taylor, |p''| <= n^2 M by
//  Bernstein).
// Extent along +a of the positive lobes: m = sup { h_a(d) : f(d) > 0, d_a > 0 }. If there is such a d, the supremum is attained
// in the open set {f > 0, d_a > 0}, as h_a vanishes on its border; so it is a critical point d0 of h_a and (2) holds along the
// great circle to its nearest sample q. If d_a(q) > 0 and f(q) > 0, the sample is counted: h_a(q) <= s := the largest h_a of
// samples with f > 0, at least 0. If d_a(q) > 0 and f(q) <= 0, then h_a(q) <= 0 <= s. If d_a(q) <= 0, the circle crosses d_a =
// 0 nearer than q, where h_a = 0 <= s. In all three cases m <= s + n^2 M tau^2 / 2, and m <= M always. This uses no symmetry of
// f, so it holds for full layouts too; the extent along -a is the same with -h_a. With negative lobes shown the surface is
// |f(d)| d and the same argument holds for sign(f(d0)) h_a on {d_a > 0}, s counting |h_a| of all samples with d_a > 0. Radius:
// of |f| by (1), of the positive lobes by (2) at the maximum of f, whose value may be negative: then nothing is visible.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "math/sh_layout.h"

namespace radiata {

/// About the glyph's centre, in units of the coefficients' function. All zero if no direction has a visible lobe.
struct GlyphBounds {
    glm::vec3 min{0}, max{0};  ///< box of the visible surface; contains the centre
    float radius = 0;          ///< of the sphere about the centre that holds the visible surface
    float amplitude_max = 0;   ///< largest sampled |f|, both signs, not enlarged
};

/// Bounds of many glyphs of one layout. Immutable after construction; evaluate() may run on several threads at once.
class BoundsEvaluator {
public:
    /// Chooses the directions so that 1 / cos((lmax + 1) tau) <= 1.02 and tabulates the basis on them.
    explicit BoundsEvaluator(ShLayout layout);

    /// \param coefficients    n * layout.count() values, internal convention, glyph by glyph; any finite values
    /// \param negative_lobes  the surface is |f(d)| d; else only where f > 0
    /// \param out             n bounds, never smaller than the glyph. Radius and extents are too large by at most 2.1 % of
    ///                        max |f| and max |d_a f| over all directions, hidden lobes too. Values beyond float saturate.
    /// \throws Error(kInvalidArgument) for a coefficient that is not finite, Error(kInternal) for spans that do not match
    void evaluate(std::span<const float> coefficients, bool negative_lobes, std::span<GlyphBounds> out) const;

    ShLayout layout() const { return layout_; }
    /// Unit; half of the sphere for even layouts.
    const std::vector<glm::dvec3>& directions() const { return directions_; }
    /// tau, radians: an upper bound of the angle from any direction to its nearest sample.
    double coveringRadius() const { return covering_radius_; }

private:
    void evaluateBlock(std::span<const float> coefficients, bool negative_lobes, std::span<GlyphBounds> out) const;

    ShLayout layout_;
    std::vector<glm::dvec3> directions_;
    double covering_radius_ = 0;
    std::vector<float> tiles_;  ///< per 16 directions: their x, y, z, then each basis function, 16 values each
};

}  // namespace radiata
