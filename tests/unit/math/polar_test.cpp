// The orthogonal factor of matrices built from a known one.
#include "math/polar.h"

#include <gtest/gtest.h>
#include <glm/gtc/quaternion.hpp>

#include <random>

#include "base/error.h"

namespace radiata {
namespace {

double distance(const glm::dmat3& a, const glm::dmat3& b) {
    double worst = 0;
    for (int c = 0; c < 3; ++c) {
        for (int r = 0; r < 3; ++r) worst = std::max(worst, std::abs(a[c][r] - b[c][r]));
    }
    return worst;
}

TEST(Polar, FindsTheRotationBehindVoxelSizesAndFlips) {
    // A = Q D with D diagonal and positive: the factor is Q. Bound 1e-13, voxel edges 0.1 to 10 mm.
    std::mt19937 random(9);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> edge(0.1, 10);
    for (int i = 0; i < 200; ++i) {
        glm::dmat3 q =
            glm::mat3_cast(glm::normalize(glm::dquat(normal(random), normal(random), normal(random), normal(random))));
        if (i % 2 != 0) q[0] = -q[0];
        const glm::dmat3 a(q[0] * edge(random), q[1] * edge(random), q[2] * edge(random));
        EXPECT_LT(distance(orthogonalPolarFactor(a), q), 1e-13);
    }
}

TEST(Polar, IgnoresSymmetricShear) {
    const glm::dmat3 stretch(glm::dvec3(2, 0.3, 0.1), glm::dvec3(0.3, 1, 0.2), glm::dvec3(0.1, 0.2, 3));
    EXPECT_LT(distance(orthogonalPolarFactor(stretch), glm::dmat3(1.0)), 1e-13);
    EXPECT_LT(distance(orthogonalPolarFactor(-stretch), glm::dmat3(-1.0)), 1e-13);
}

TEST(Polar, IsOrthogonalForLongThinVoxels) {
    const glm::dmat3 q =
        orthogonalPolarFactor(glm::dmat3(glm::dvec3(1e-3, 0, 0), glm::dvec3(1e-4, 1e3, 0), glm::dvec3(0, 0, 1)));
    EXPECT_LT(distance(glm::transpose(q) * q, glm::dmat3(1.0)), 1e-14);
}

TEST(Polar, RefusesSingularAndNonFiniteMatrices) {
    EXPECT_THROW(orthogonalPolarFactor(glm::dmat3(0.0)), Error);
    EXPECT_THROW(orthogonalPolarFactor(glm::dmat3(glm::dvec3(1, 0, 0), glm::dvec3(2, 0, 0), glm::dvec3(0, 0, 1))), Error);
    EXPECT_THROW(orthogonalPolarFactor(glm::dmat3(std::nan(""))), Error);
}

}  // namespace
}  // namespace radiata
