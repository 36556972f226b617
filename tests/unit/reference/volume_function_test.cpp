// The reference of volumes against formulas, and against samples, gradients and first hits that another program took of real
// volumes (folder RADIATA_DATA).
#include "reference/volume_function.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>

#include "reference/cubic.h"

namespace radiata::reference {
namespace {

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

TEST(VolumeFunction, IsExactForLinearFields) {
    const glm::dvec3 slope(2, -1, 0.5);
    const model::ScalarImage image = sampled({9, 8, 7}, [&](const glm::dvec3& p) { return glm::dot(slope, p) - 3; });
    const VolumeFunction volume(image);
    const glm::dvec3 p(3.25, 4.5, 2.875);
    EXPECT_NEAR(volume.value(p), glm::dot(slope, p) - 3, 1e-12);
    EXPECT_LT(glm::length(volume.gradient(p) - slope), 1e-12);
    EXPECT_LT(glm::length(volume.splineGradient(p) - slope), 1e-12);
    EXPECT_NEAR(volume.splineValue(p), glm::dot(slope, p) - 3, 1e-12);
}

TEST(VolumeFunction, SplineHasTheGradientOfQuadraticFieldsAndAValueAThirdOfTheCurvatureHigher) {
    const auto field = [](const glm::dvec3& p) { return p.x * p.x - 2 * p.y * p.y + p.x * p.z; };
    const model::ScalarImage image = sampled({10, 10, 10}, field);
    const VolumeFunction volume(image);
    const glm::dvec3 p(4.3, 5.1, 3.7);
    EXPECT_LT(glm::length(volume.splineGradient(p) - glm::dvec3(2 * p.x + p.z, -4 * p.y, p.x)), 1e-10);
    // h^2 / 6 times the Laplacian, which is 2 - 4.
    EXPECT_NEAR(volume.splineValue(p), field(p) - 2.0 / 6, 1e-10);
}

TEST(VolumeFunction, HitsASphereWithAnErrorThatFallsWithTheSquareOfTheSpacing) {
    double last = 1;
    for (const int size : {17, 33, 65}) {
        const double middle = 0.5 * (size - 1), radius = 0.6 * middle;
        const model::ScalarImage image =
            sampled(glm::ivec3(size), [&](const glm::dvec3& p) { return radius * radius - glm::dot(p - middle, p - middle); });
        const VolumeFunction volume(image);
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
