// Marched level sets and smoothed gradients against closed forms.
#include "reference/scalar_field.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace radiata::reference {
namespace {

TEST(ScalarField, IsTrilinearBetweenItsSamples) {
    const auto f = [](const glm::dvec3& p) { return 1 + 2 * p.x - p.y + 3 * p.z + 0.5 * p.x * p.y - p.x * p.y * p.z; };
    const ScalarField field(glm::ivec3(4, 5, 3), f);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> uniform;
    for (int i = 0; i < 100; ++i) {
        const glm::dvec3 p(3 * uniform(random), 4 * uniform(random), 2 * uniform(random));
        EXPECT_NEAR(field.value(p), f(p), 1e-12);
    }
    EXPECT_NEAR(field.value({-1, 0, 0}), 1, 1e-15) << "clamped";
}

TEST(ScalarField, SmoothGradientsOfQuadraticsAreExact) {
    const ScalarField field(glm::ivec3(9), [](const glm::dvec3& p) { return p.x * p.x - 2 * p.y * p.z + 3 * p.z; });
    std::mt19937 random(2);
    std::uniform_real_distribution<double> uniform(2, 6);
    for (int i = 0; i < 100; ++i) {
        const glm::dvec3 p(uniform(random), uniform(random), uniform(random));
        EXPECT_LT(glm::length(field.smoothGradient(p) - glm::dvec3(2 * p.x, -2 * p.z, 3 - 2 * p.y)), 1e-12);
    }
}

TEST(ScalarField, CrossesPlanesWhereTheyAre) {
    const ScalarField field(glm::ivec3(12), [](const glm::dvec3& p) { return p.z + 0.25 * p.x; });
    const glm::dvec3 d = glm::normalize(glm::dvec3(0.3, 0.2, 0.9)), from(1, 2, 0);
    EXPECT_NEAR(field.firstCrossing(from, d, 100, 6.1).value(), (6.1 - 0.25) / (d.z + 0.25 * d.x), 1e-9);
    EXPECT_NEAR(field.firstCrossing(from + 9.0 * d, -d, 100, 6.1).value(), 9 - (6.1 - 0.25) / (d.z + 0.25 * d.x), 1e-9);
    EXPECT_FALSE(field.firstCrossing(from, d, 5, 6.1)) << "beyond the ray's end";
    EXPECT_FALSE(field.firstCrossing({-5, 20, 3}, {1, 0, 0}, 100, 3)) << "beside the box";
}

TEST(ScalarField, FindsThinSheetsBetweenSteps) {
    // Along x the values of a cell's diagonal make a parabola that is above 0 over 0.06 voxels.
    const ScalarField field(glm::ivec3(2), std::vector<double>{0, 1, 1, 0, 0, 1, 1, 0});
    const glm::dvec3 d = glm::normalize(glm::dvec3(1, 1, 0));
    const double peak = 0.5, half_width = 0.02;
    const double iso = 2 * peak * (1 - peak) - 2 * half_width * half_width;
    const auto t = field.firstCrossing({0, 0, 0.5}, d, 10, iso, 0.13);
    ASSERT_TRUE(t);
    EXPECT_NEAR(*t, (peak - half_width) * std::sqrt(2.0), 1e-8);
}

}  // namespace
}  // namespace radiata::reference
