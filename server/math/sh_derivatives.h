// A function on the sphere with its slope and curvature along the sphere, in double. Internal SH convention.
#pragma once

#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "math/sh_layout.h"

namespace radiata {

/// At one direction p. Derivatives are those along the unit sphere, per radian; the two tangents are unit, orthogonal to p and
/// to each other.
struct SphereDerivatives {
    double value = 0;
    glm::dvec3 tangent[2];
    double slope[2] = {0, 0};             ///< along the tangents
    double curvature[2][2] = {{0}, {0}};  ///< second covariant derivative in the tangents' basis, symmetric
};

class ShDerivatives {
public:
    /// \throws Error(kInternal) if the number of coefficients does not fit the layout
    ShDerivatives(ShLayout layout, std::span<const double> coefficients);

    /// \param p  unit
    /// |error| < 1e-12 times the bound of the value's, slope's or curvature's size (tests/unit/math/sh_derivatives_test.cpp).
    /// Method: f is the restriction of F = sum_m Re (x + i y)^m A_m(z) + Im (x + i y)^m B_m(z), with polynomials A_m, B_m by
    /// the three-term recurrence of normalised Legendre functions. With P = 1 - p p^T, slope = P grad F and
    /// curvature = P (hess F - (p . grad F)) P, whatever F is off the sphere.
    SphereDerivatives operator()(const glm::dvec3& p) const;

    /// Bound of |second derivative along any great circle|: sum over bands of l^2 times their largest possible value.
    double curvatureBound() const { return curvature_bound_; }

private:
    struct Term {
        double a, b, cosine, sine;  ///< Q_l = a z Q_(l-1) - b Q_(l-2); coefficients of Q_l in A_m and B_m
    };
    std::vector<std::vector<Term>> orders_;  ///< of m = 0, 1, ...; terms of l = m, m + 1, ...
    double curvature_bound_ = 0;
};

}  // namespace radiata
