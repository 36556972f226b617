// Values, gradients and both ways to find level sets against closed forms.
#include "reference/scalar_field.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "reference/cubic.h"

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
        EXPECT_LT(glm::length(field.splineGradient(p) - glm::dvec3(2 * p.x, -2 * p.z, 3 - 2 * p.y)), 1e-12);
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

template <typename Function>
model::ScalarImage sampled(const glm::ivec3& size, const Function& function) {
    model::ScalarImage image;
    image.size = size;
    for (int k = 0; k < size.z; ++k) {
        for (int j = 0; j < size.y; ++j) {
            for (int i = 0; i < size.x; ++i) image.values.push_back(static_cast<float>(function(glm::dvec3(i, j, k))));
        }
    }
    return image;
}

TEST(ScalarField, IsExactForLinearFields) {
    const glm::dvec3 slope(2, -1, 0.5);
    const model::ScalarImage image = sampled({9, 8, 7}, [&](const glm::dvec3& p) { return glm::dot(slope, p) - 3; });
    const ScalarField volume(image);
    const glm::dvec3 p(3.25, 4.5, 2.875);
    EXPECT_NEAR(volume.value(p), glm::dot(slope, p) - 3, 1e-12);
    EXPECT_LT(glm::length(volume.gradient(p) - slope), 1e-12);
    // At the volume's faces, edges and corners too.
    for (const glm::dvec3& at : {p, glm::dvec3(0.25, 4.5, 2.875), glm::dvec3(8, 6.5, 0), glm::dvec3(0), glm::dvec3(8, 7, 6)}) {
        EXPECT_LT(glm::length(volume.splineGradient(at) - slope), 1e-12);
        EXPECT_NEAR(volume.splineValue(at), glm::dot(slope, at) - 3, 1e-12);
    }
}

TEST(ScalarField, SplineHasTheGradientOfQuadraticFieldsAndAValueAThirdOfTheCurvatureHigher) {
    const auto field = [](const glm::dvec3& p) { return p.x * p.x - 2 * p.y * p.y + p.x * p.z; };
    const model::ScalarImage image = sampled({10, 10, 10}, field);
    const ScalarField volume(image);
    const glm::dvec3 p(4.3, 5.1, 3.7);
    EXPECT_LT(glm::length(volume.splineGradient(p) - glm::dvec3(2 * p.x + p.z, -4 * p.y, p.x)), 1e-10);
    // h^2 / 6 times the Laplacian, which is 2 - 4.
    EXPECT_NEAR(volume.splineValue(p), field(p) - 2.0 / 6, 1e-10);
}

TEST(ScalarField, HitsASphereWithAnErrorThatFallsWithTheSquareOfTheSpacing) {
    double last = 1;
    for (const int size : {17, 33, 65}) {
        const double middle = 0.5 * (size - 1), radius = 0.6 * middle;
        const model::ScalarImage image =
            sampled(glm::ivec3(size), [&](const glm::dvec3& p) { return radius * radius - glm::dot(p - middle, p - middle); });
        const ScalarField volume(image);
        std::mt19937 random(3);
        std::normal_distribution<double> normal;
        double worst = 0;
        for (int i = 0; i < 200; ++i) {
            const glm::dvec3 d = glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
            const auto hit = volume.firstHit(glm::dvec3(middle), d, 0, 0, 1e9);
            ASSERT_TRUE(hit);
            worst = std::max(worst, std::abs(hit->t - radius) / radius);
        }
        EXPECT_LT(worst, last / 3.5);
        last = worst;
    }
}

TEST(ChordRoot, FindsTwoRootsBetweenEndsOfOneSign) {
    // Along the diagonal from (0, 0, 0) to (1, 1, 0) of a saddle: 1 - 6 u (1 - u) has two roots.
    const std::array<double, 8> saddle{1, -2, -2, 1, 1, -2, -2, 1};
    const auto root = firstChordRoot(saddle, 0, {0, 0, 0.5}, {1, 1, 0.5});
    ASSERT_TRUE(root);
    EXPECT_NEAR(root->u, 0.5 - std::sqrt(0.25 - 1.0 / 6), 1e-12);
    EXPECT_FALSE(firstChordRoot(saddle, -0.75, {0, 0, 0.5}, {1, 1, 0.5}));
    EXPECT_NEAR(root->margin, 0.5, 1e-3);
}

}  // namespace
}  // namespace radiata::reference
