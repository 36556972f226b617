// A function on the sphere given by spherical-harmonics coefficients, evaluated slowly and exactly in double.
// Twin of the generated straight-line code in the shaders: Clenshaw's backward summation for each order m instead of a forward
// recurrence, and derivatives by M. Riesz's interpolation formula instead of differentiated polynomials.
#pragma once

#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "math/sh_layout.h"

namespace radiata::reference {

class ShFunction {
public:
    /// \param coefficients  layout.count() values in the internal convention (ShConvention::kDescoteaux07)
    /// \throws Error(kInternal) if their number does not fit the layout
    ShFunction(ShLayout layout, std::span<const double> coefficients);
    ShFunction(ShLayout layout, std::span<const float> coefficients);

    ShLayout layout() const { return layout_; }

    /// f(direction / |direction|). |error| < 1e-13 times the sum of |coefficients|. \param direction  not zero
    double operator()(const glm::dvec3& direction) const;

    /// Gradient along the unit sphere at direction / |direction|: orthogonal to it, in units of f per radian.
    /// |error| < 1e-12 times the sum of |coefficients|: the formula is exact for the degree of f and adds rounding only.
    glm::dvec3 gradient(const glm::dvec3& direction) const;

private:
    /// One order m: f gets  Re (x + i y)^m sum_l cosine_l Q_l(z)  +  Im (x + i y)^m sum_l sine_l Q_l(z),
    /// with Q_(l+1) = a_l z Q_l + b_l Q_(l-1), Q_m = 1. Entry i belongs to band l = m + i.
    struct Order {
        std::vector<double> a, b, cosine, sine;
    };
    void prepare(std::span<const double> coefficients);

    ShLayout layout_;
    std::vector<Order> orders_;
};

/// A unit vector orthogonal to the given one, which need not be of unit length.
glm::dvec3 anyOrthogonal(const glm::dvec3& v);

}  // namespace radiata::reference
