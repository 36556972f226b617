// Turning (or mirroring) functions on the sphere that are given by spherical-harmonics coefficients.
#pragma once

#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "math/sh_layout.h"

namespace radiata {

/// A linear map of coefficients in the internal convention, built once and applied to many functions.
/// The matrix of each band is an integral over products of two harmonics of that band, done exactly by a product rule
/// (Gauss-Legendre in z, equal steps in azimuth), so no Euler angles and no special cases: reflections work the same way.
class ShRotation {
public:
    /// g = f turned by `orthogonal`: g(orthogonal * d) = f(d) for every direction d.
    /// \param orthogonal  rotation or reflection, orthogonal to 1e-9
    /// \throws Error(kInvalidArgument) if it is not orthogonal
    ShRotation(ShLayout layout, const glm::dmat3& orthogonal);

    /// Replaces the coefficients of f by those of g. |error| < 1e-13 of the band's norm (tests/unit/math/sh_rotation_test.cpp).
    /// \param coefficients  layout.count() values
    void apply(std::span<double> coefficients) const;

private:
    ShLayout layout_;
    std::vector<double> bands_;  ///< for l = 0, step, ... lmax: (2l+1) x (2l+1), row by row
};

}  // namespace radiata
