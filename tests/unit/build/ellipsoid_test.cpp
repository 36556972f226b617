// Ellipsoids of tensors of order 2: half axes, box, inverse, and what becomes of tensors without volume.
#include "build/ellipsoid.h"

#include <gtest/gtest.h>
#include <glm/gtc/quaternion.hpp>

#include <cmath>
#include <random>

namespace radiata {
namespace {

glm::dmat3 matrixOf(const std::array<float, 6>& m) { return glm::dmat3(m[0], m[1], m[2], m[1], m[3], m[4], m[2], m[4], m[5]); }

TEST(Ellipsoid, HasTheEigenvaluesAsHalfAxesAndATightBox) {
    std::mt19937 random(41);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> uniform(-1, 2);
    for (int n = 0; n < 200; ++n) {
        const double unit = std::pow(10.0, n % 9 - 4);  // from 1e-4 mm^2/s on
        const glm::dvec3 values(unit * uniform(random), unit * uniform(random), unit * uniform(random));
        const glm::dmat3 turn =
            glm::mat3_cast(glm::normalize(glm::dquat(normal(random), normal(random), normal(random), normal(random))));
        glm::dmat3 tensor(0.0), absolute(0.0);
        const double longest = std::max({std::abs(values.x), std::abs(values.y), std::abs(values.z)});
        for (int i = 0; i < 3; ++i) {
            tensor += values[i] * glm::outerProduct(turn[i], turn[i]);
            absolute += std::max(std::abs(values[i]), kEllipsoidFlattest * longest) * glm::outerProduct(turn[i], turn[i]);
        }
        const std::array<float, 6> components{float(tensor[0][0]), float(tensor[0][1]), float(tensor[0][2]),
                                              float(tensor[1][1]), float(tensor[1][2]), float(tensor[2][2])};
        const Ellipsoid ellipsoid = ellipsoidOf(components);
        EXPECT_NEAR(ellipsoid.longest, longest, 1e-6 * longest);
        EXPECT_GE(ellipsoid.radius, ellipsoid.longest);
        glm::dvec3 farthest(0);
        for (int i = 0; i < 2000; ++i) {
            const glm::dvec3 u = glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
            const glm::dvec3 p = absolute * u;
            farthest = glm::max(farthest, glm::abs(p));
            EXPECT_LE(glm::length(p), static_cast<double>(ellipsoid.radius));
            if (i < 20 && glm::determinant(absolute) > 1e-2 * longest * longest * longest) {
                EXPECT_NEAR(glm::length(matrixOf(ellipsoid.inverse) * p), 1, 1e-4);
            }
        }
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_LE(farthest[axis], static_cast<double>(ellipsoid.extent[axis]));
            EXPECT_GT(farthest[axis], 0.9 * static_cast<double>(ellipsoid.extent[axis]));
        }
    }
}

TEST(Ellipsoid, OfADegenerateTensorIsADiscANeedleOrNothing) {
    const Ellipsoid needle = ellipsoidOf(std::array<float, 6>{2, 0, 0, 0, 0, 0});
    EXPECT_NEAR(needle.extent.x, 2, 1e-5);
    EXPECT_NEAR(needle.extent.y, 2 * kEllipsoidFlattest, 1e-5);
    EXPECT_EQ(ellipsoidOf(std::array<float, 6>{}).radius, 0);
    const Ellipsoid huge = ellipsoidOf(std::array<float, 6>{1e30F, 0, 0, 1e30F, 0, 1e-30F});
    EXPECT_TRUE(std::isfinite(huge.radius) && std::isfinite(huge.inverse[5]));
}

}  // namespace
}  // namespace radiata
