// Random functions and rays for the tests of the reference; fixed seeds.
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include <glm/glm.hpp>

#include "math/sh_layout.h"

namespace radiata::test {

inline double uniform(std::mt19937_64& random, double low, double high) {
    return low + (high - low) * std::generate_canonical<double, 53>(random);
}

inline glm::dvec3 unitVector(std::mt19937_64& random) {
    for (;;) {
        const glm::dvec3 v(uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1));
        const double length = glm::length(v);
        if (length > 0.1 && length < 1) return v / length;
    }
}

/// Coefficients in [-1, 1] that fall with the band.
inline std::vector<double> randomCoefficients(std::mt19937_64& random, ShLayout layout) {
    std::vector<double> coefficients(layout.count());
    for (int l = 0; l <= layout.lmax; l += layout.step()) {
        for (int m = -l; m <= l; ++m) coefficients[layout.index(l, m)] = uniform(random, -1, 1) / (1 + l);
    }
    return coefficients;
}

}  // namespace radiata::test
