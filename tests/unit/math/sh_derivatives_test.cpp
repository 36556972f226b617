// Slope and curvature against central differences of the plain evaluator.
#include "math/sh_derivatives.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "base/error.h"
#include "math/sh_evaluate.h"

namespace radiata {
namespace {

TEST(ShDerivatives, AgreeWithCentralDifferencesForEveryLayout) {
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    double worst_value = 0, worst_slope = 0, worst_curvature = 0;
    for (const bool full : {false, true}) {
        for (int lmax = 0; lmax <= 16; lmax += full ? 1 : 2) {
            const ShLayout layout{lmax, full};
            std::vector<double> coefficients(layout.count());
            for (double& c : coefficients) c = normal(random);
            const ShDerivatives f(layout, coefficients);
            const double scale = f.curvatureBound() + 1;
            for (int i = 0; i < 40; ++i) {
                // The poles and the equator too.
                glm::dvec3 p = glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
                if (i == 0) p = {0, 0, 1};
                if (i == 1) p = {0, -1, 0};
                const SphereDerivatives d = f(p);
                const auto at = [&](double a, double b) {
                    const glm::dvec3 way = a * d.tangent[0] + b * d.tangent[1];
                    const double angle = glm::length(way);
                    const glm::dvec3 q = angle > 0 ? std::cos(angle) * p + std::sin(angle) / angle * way : p;
                    return evaluateSh(layout, std::span<const double>(coefficients), q);
                };
                worst_value = std::max(worst_value, std::abs(d.value - at(0, 0)) / scale);
                const double h = 1e-4;
                const double slopes[] = {(at(h, 0) - at(-h, 0)) / (2 * h), (at(0, h) - at(0, -h)) / (2 * h)};
                const double uu = (at(h, 0) - 2 * at(0, 0) + at(-h, 0)) / (h * h);
                const double vv = (at(0, h) - 2 * at(0, 0) + at(0, -h)) / (h * h);
                const double uv = (at(h, h) - at(h, -h) - at(-h, h) + at(-h, -h)) / (4 * h * h);
                for (int k = 0; k < 2; ++k) worst_slope = std::max(worst_slope, std::abs(d.slope[k] - slopes[k]) / scale);
                for (const double difference : {d.curvature[0][0] - uu, d.curvature[1][1] - vv, d.curvature[0][1] - uv}) {
                    worst_curvature = std::max(worst_curvature, std::abs(difference) / scale);
                }
                EXPECT_NEAR(d.curvature[0][1], d.curvature[1][0], 1e-13 * scale);
                EXPECT_LE(std::abs(d.curvature[0][0]), f.curvatureBound() * (1 + 1e-12));
            }
        }
    }
    // What is left of the slopes and curvatures is the error of the differences.
    EXPECT_LT(worst_value, 1e-13);
    EXPECT_LT(worst_slope, 1e-6);
    EXPECT_LT(worst_curvature, 1e-5);
}

TEST(ShDerivatives, RefuseCoefficientsThatDoNotFit) { EXPECT_THROW(ShDerivatives({4, false}, std::vector<double>(14)), Error); }

}  // namespace
}  // namespace radiata
