#include "reference/sh_function.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "base/error.h"
#include "random_glyphs.h"

namespace radiata::reference {
namespace {

using test::randomCoefficients;
using test::unitVector;

/// The definition in math/sh_convention.h, by the standard library's spherical harmonics.
double fromStandardLibrary(ShLayout layout, const std::vector<double>& c, const glm::dvec3& p) {
    const double theta = std::atan2(std::hypot(p.x, p.y), p.z), angle = std::atan2(p.y, p.x);
    double sum = 0;
    for (int l = 0; l <= layout.lmax; l += layout.step()) {
        for (int m = -l; m <= l; ++m) {
            const double legendre = std::sph_legendre(unsigned(l), unsigned(std::abs(m)), theta);
            const double sign = m < 0 && m % 2 != 0 ? -1 : 1;
            const double azimuth = m == 0  ? 1
                                   : m < 0 ? sign * std::numbers::sqrt2 * std::cos(m * angle)
                                           : std::numbers::sqrt2 * std::sin(m * angle);
            sum += c[layout.index(l, m)] * legendre * azimuth;
        }
    }
    return sum;
}

TEST(ShFunction, AgreesWithTheStandardLibraryTo1e12) {
    std::mt19937_64 random(1);
    for (const ShLayout layout : {ShLayout{0, false}, ShLayout{4, false}, ShLayout{8, false}, ShLayout{16, false},
                                  ShLayout{1, true}, ShLayout{7, true}, ShLayout{16, true}}) {
        const std::vector<double> c = randomCoefficients(random, layout);
        const ShFunction f(layout, c);
        for (int i = 0; i < 200; ++i) {
            const glm::dvec3 p = unitVector(random);
            EXPECT_NEAR(f(3.0 * p), fromStandardLibrary(layout, c, p), 1e-12) << layout.lmax;
        }
    }
}

TEST(ShFunction, HasTheSignsOfPeters2023AppendixA) {
    const ShLayout layout{4, false};
    const glm::dvec3 p = glm::normalize(glm::dvec3(0.3, -0.5, 0.7));
    const double pi = std::numbers::pi, x = p.x, y = p.y, z = p.z;
    const double expected[15] = {
        1 / (2 * std::sqrt(pi)),
        std::sqrt(15 / (16 * pi)) * (x * x - y * y),
        std::sqrt(15 / (4 * pi)) * x * z,
        std::sqrt(5 / (16 * pi)) * (3 * z * z - 1),
        -std::sqrt(15 / (4 * pi)) * y * z,
        std::sqrt(15 / (4 * pi)) * x * y,
        3.0 / 16 * std::sqrt(35 / pi) * (x * x * x * x - 6 * x * x * y * y + y * y * y * y),
        3.0 / 8 * std::sqrt(70 / pi) * x * (x * x - 3 * y * y) * z,
        3.0 / 8 * std::sqrt(5 / pi) * (x * x - y * y) * (7 * z * z - 1),
        3.0 / 8 * std::sqrt(10 / pi) * x * z * (7 * z * z - 3),
        3.0 / (16 * std::sqrt(pi)) * (35 * z * z * z * z - 30 * z * z + 3),
        -3.0 / 8 * std::sqrt(10 / pi) * y * z * (7 * z * z - 3),
        3.0 / 4 * std::sqrt(5 / pi) * x * y * (7 * z * z - 1),
        3.0 / 8 * std::sqrt(70 / pi) * (y * y - 3 * x * x) * y * z,
        3.0 / 4 * std::sqrt(35 / pi) * x * y * (x * x - y * y),
    };
    for (std::size_t i = 0; i < 15; ++i) {
        std::vector<double> c(15, 0.0);
        c[i] = 1;
        EXPECT_NEAR(ShFunction(layout, c)(p), expected[i], 1e-14) << i;
    }
}

TEST(ShFunction, IsDefinedAtThePoles) {
    std::mt19937_64 random(2);
    const ShLayout layout{16, true};
    const std::vector<double> c = randomCoefficients(random, layout);
    const ShFunction f(layout, c);
    for (const double z : {1.0, -1.0}) {
        double expected = 0;
        for (int l = 0; l <= 16; ++l) {
            expected += c[layout.index(l, 0)] * std::sqrt((2 * l + 1) / (4 * std::numbers::pi)) * std::pow(z, l);
        }
        EXPECT_NEAR(f({0, 0, z}), expected, 1e-13);
        EXPECT_TRUE(std::isfinite(glm::length(f.gradient({0, 0, z}))));
    }
}

TEST(ShFunction, GradientAgreesWithCentralDifferencesTo1e7) {
    std::mt19937_64 random(3);
    for (const ShLayout layout : {ShLayout{0, false}, ShLayout{2, false}, ShLayout{8, false}, ShLayout{16, true}}) {
        const ShFunction f(layout, randomCoefficients(random, layout));
        for (int i = 0; i < 50; ++i) {
            const glm::dvec3 p = unitVector(random), tangent = anyOrthogonal(p);
            const double h = 1e-5;
            const double slope = (f(p + h * tangent) - f(p - h * tangent)) / (2 * std::atan(h));
            EXPECT_NEAR(glm::dot(f.gradient(2.0 * p), tangent), slope, 1e-7);
            EXPECT_NEAR(glm::dot(f.gradient(p), p), 0, 1e-13);
        }
    }
}

TEST(ShFunction, GradientOfBandOneIsExact) {
    // f = sqrt(3 / 4 pi) z has the tangential gradient sqrt(3 / 4 pi) (e_z - z p).
    const ShFunction f({1, true}, std::vector<double>{0, 0, 1, 0});
    const glm::dvec3 p = glm::normalize(glm::dvec3(1, 2, -0.5));
    const glm::dvec3 expected = std::sqrt(3 / (4 * std::numbers::pi)) * (glm::dvec3(0, 0, 1) - p.z * p);
    EXPECT_LT(glm::length(f.gradient(p) - expected), 1e-14);
}

TEST(ShFunction, RefusesAWrongNumberOfCoefficients) { EXPECT_THROW(ShFunction({4, false}, std::vector<double>(14)), Error); }

}  // namespace
}  // namespace radiata::reference
