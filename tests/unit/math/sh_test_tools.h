// Spherical harmonics by their definition, from the standard library's associated Legendre functions: the oracle for the
// recurrences of server/math.
#pragma once

#include <cmath>
#include <complex>
#include <numbers>
#include <random>
#include <vector>

#include <glm/glm.hpp>

#include "math/sh_convention.h"
#include "math/sh_layout.h"

namespace radiata::test {

/// Complex Y_l^m with Condon-Shortley phase, any m.
inline std::complex<double> complexHarmonic(int l, int m, const glm::dvec3& direction) {
    const double theta = std::atan2(std::hypot(direction.x, direction.y), direction.z);
    const double phi = std::atan2(direction.y, direction.x);
    const auto order = static_cast<unsigned>(std::abs(m));
    const std::complex<double> positive =
        std::sph_legendre(static_cast<unsigned>(l), order, theta) * std::polar(1.0, static_cast<double>(order) * phi);
    if (m >= 0) return positive;
    return (m % 2 != 0 ? -1.0 : 1.0) * std::conj(positive);
}

/// The table in math/sh_convention.h, word by word.
inline double basisFunction(ShConvention convention, int l, int m, const glm::dvec3& direction) {
    using std::numbers::sqrt2;
    if (m == 0) return complexHarmonic(l, 0, direction).real();
    const int size = std::abs(m);
    switch (convention) {
        case ShConvention::kDescoteaux07:
            return sqrt2 * (m < 0 ? complexHarmonic(l, m, direction).real() : complexHarmonic(l, m, direction).imag());
        case ShConvention::kDescoteaux07Legacy:
            return sqrt2 * (m < 0 ? complexHarmonic(l, size, direction).real() : complexHarmonic(l, m, direction).imag());
        case ShConvention::kTournier07:
            return sqrt2 * (m < 0 ? complexHarmonic(l, size, direction).imag() : complexHarmonic(l, m, direction).real());
        case ShConvention::kMrtrix02:
            return m < 0 ? complexHarmonic(l, size, direction).imag() : complexHarmonic(l, m, direction).real();
    }
    return 0;
}

inline double evaluateByDefinition(ShConvention convention, ShLayout layout, const std::vector<double>& coefficients,
                                   const glm::dvec3& direction) {
    double sum = 0;
    for (int l = 0; l <= layout.lmax; l += layout.step()) {
        for (int m = -l; m <= l; ++m) {
            sum += coefficients[layout.index(l, m)] * basisFunction(convention, l, m, direction);
        }
    }
    return sum;
}

inline glm::dvec3 randomDirection(std::mt19937& random) {
    std::normal_distribution<double> normal;
    return glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
}

inline std::vector<double> randomCoefficients(std::mt19937& random, ShLayout layout) {
    std::uniform_real_distribution<double> uniform(-1, 1);
    std::vector<double> coefficients(layout.count());
    for (double& value : coefficients) value = uniform(random);
    return coefficients;
}

}  // namespace radiata::test
