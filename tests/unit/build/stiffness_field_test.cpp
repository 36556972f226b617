// The sample of elasticity tensors: physically possible, different from place to place, the same for the same seed.
#include "build/stiffness_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "base/error.h"
#include "math/elasticity.h"
#include "math/sh_evaluate.h"

namespace radiata {
namespace {

/// Whether the symmetric 6x6 matrix is positive definite: Cholesky's factorisation goes through.
bool positiveDefinite(std::vector<double> m) {
    for (std::size_t k = 0; k < 6; ++k) {
        for (std::size_t j = 0; j < k; ++j) m[7 * k] -= m[6 * k + j] * m[6 * k + j];
        if (!(m[7 * k] > 0)) return false;
        m[7 * k] = std::sqrt(m[7 * k]);
        for (std::size_t i = k + 1; i < 6; ++i) {
            for (std::size_t j = 0; j < k; ++j) m[6 * i + k] -= m[6 * i + j] * m[6 * k + j];
            m[6 * i + k] /= m[7 * k];
        }
    }
    return true;
}

TEST(StiffnessField, StoresEnergyInEveryStrain) {
    const StiffnessField field = stiffnessField({.seed = 7, .size = 8});
    EXPECT_EQ(field.size, glm::ivec3(8, 4, 4));
    ASSERT_EQ(field.matrices.size(), 128U);
    for (const auto& matrix : field.matrices) EXPECT_TRUE(positiveDefinite(fullMatrix(matrix)));
}

TEST(StiffnessField, IsMadeFromItsSeed) {
    EXPECT_EQ(stiffnessField({.seed = 1, .size = 6}).matrices, stiffnessField({.seed = 1, .size = 6}).matrices);
    EXPECT_NE(stiffnessField({.seed = 1, .size = 6}).matrices, stiffnessField({.seed = 2, .size = 6}).matrices);
    EXPECT_THROW(stiffnessField({.seed = 1, .size = 1}), Error);
    EXPECT_THROW(stiffnessField({.seed = 1, .size = 257}), Error);
}

TEST(StiffnessField, AsAnImageIsTheContractionOfEachMatrix) {
    const StiffnessField field = stiffnessField({.seed = 3, .size = 5});
    const model::ShImage image = stiffnessImage({.seed = 3, .size = 5});
    ASSERT_EQ(image.voxels.size(), field.matrices.size());
    EXPECT_EQ(image.voxels[6], glm::ivec3(1, 1, 0));
    std::mt19937 random(9);
    std::normal_distribution<double> normal;
    for (std::size_t v = 0; v < field.matrices.size(); ++v) {
        const glm::dvec3 x = glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
        const double strain[6] = {x.x * x.x, x.y * x.y, x.z * x.z, 2 * x.y * x.z, 2 * x.x * x.z, 2 * x.x * x.y};
        const std::vector<double> matrix = fullMatrix(field.matrices[v]);
        double direct = 0;
        for (std::size_t i = 0; i < 36; ++i) direct += matrix[i] * strain[i / 6] * strain[i % 6];
        const auto coefficients = std::span(image.coefficients).subspan(v * 15, 15);
        EXPECT_NEAR(evaluateSh(image.layout, coefficients, x), direct, 1e-6 * 140);  // 140 GPa is the largest modulus
    }
}

}  // namespace
}  // namespace radiata
