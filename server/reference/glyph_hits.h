// Every hit of a ray with a glyph, found by exhaustive bracketing in double. Twin of the march and of the polynomial solver in
// the shaders; neither Fourier coefficients nor polynomials appear here, only values of f.
// Source of the equation: Peters et al. 2023, Eq. 1 and 11; in the ray's plane, with the angle psi from the ray's direction,
// a point of the ray lies at distance h / sin psi, so hits are the solutions of f(psi) sin psi = +-h.
#pragma once

#include <limits>
#include <vector>

#include <glm/glm.hpp>

#include "reference/sh_function.h"

namespace radiata::reference {

struct GlyphHit {
    double t = 0;
    double amplitude = 0;  ///< signed f in the direction of the hit; |amplitude| is the distance from the centre
    glm::dvec3 normal{0};  ///< unit, away from the inside of the glyph
};

struct GlyphHits {
    std::vector<GlyphHit> hits;  ///< ascending t
    /// Number or signs of the hits change when the line moves by 1e-5 radii away from or towards the centre.
    bool grazing = false;
    /// Largest |change of the first hit's t| under these two moves, in radii; infinite if the first hit comes, goes or changes
    /// sign. The condition of the first hit: about 1e-5 for a hit head-on, large at silhouettes.
    double first_shift = 0;
};

/// \param f        the glyph is the surface |p| = |f(p / |p|)| (both lobes) or |p| = f(p / |p|) (positive lobes)
/// \param origin   relative to the glyph's centre, same unit as f
/// \param direction  unit
/// \param t_min    hits with t < t_min are left out
/// A line through the exact centre has a hit at each end of its two lobes; the centre itself counts as none.
/// |error of t| < 1e-12 radii for hits that do not graze. Cost: some thousand evaluations of f.
GlyphHits glyphHits(const ShFunction& f, const glm::dvec3& origin, const glm::dvec3& direction, bool both_lobes,
                    double t_min = -std::numeric_limits<double>::infinity());

/// Unit normal of the glyph in the direction of p (Peters et al. 2023, Eq. 11), away from the inside.
/// \param p  any length but zero, f(p) not zero
glm::dvec3 glyphNormal(const ShFunction& f, const glm::dvec3& p);

}  // namespace radiata::reference
