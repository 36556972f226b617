// Symmetrisation, multiplicities, rotation and traces of Cartesian tensors, held against sums over all 3^n entries.
#include "math/cartesian_tensor.h"

#include <gtest/gtest.h>
#include <glm/gtc/quaternion.hpp>

#include <cmath>
#include <random>

#include "base/error.h"
#include "math/elasticity.h"
#include "unit/math/sh_test_tools.h"

namespace radiata {
namespace {

std::vector<double> randomValues(std::mt19937& random, std::size_t count) {
    std::uniform_real_distribution<double> uniform(-1, 1);
    std::vector<double> values(count);
    for (double& value : values) value = uniform(random);
    return values;
}

/// T_(i1 ... in) x_i1 ... x_in entry by entry: Eq. 2 of Hlawitschka et al., or Eq. 4 for tensors without symmetry.
double sumOfEntries(int order, const std::vector<double>& entries, const glm::dvec3& x) {
    double sum = 0;
    for (std::size_t entry = 0; entry < entries.size(); ++entry) {
        double product = entries[entry];
        std::size_t rest = entry;
        for (int i = 0; i < order; ++i, rest /= 3) product *= x[static_cast<int>(rest % 3)];
        sum += product;
    }
    return sum;
}

TEST(CartesianTensor, ComponentsStandWhereTheirIndexSays) {
    for (int order = 2; order <= kTensorOrderMax; ++order) {
        const std::vector<TensorPowers> components = symmetricComponents(order);
        ASSERT_EQ(components.size(), symmetricCount(order));
        double entries = 0;
        for (std::size_t i = 0; i < components.size(); ++i) {
            EXPECT_EQ(symmetricIndex(components[i]), i);
            entries += multiplicity(components[i]);
        }
        EXPECT_EQ(entries, static_cast<double>(entryCount(order)));
    }
    EXPECT_EQ(multiplicity({1, 1, 2}), 12);
    EXPECT_EQ(multiplicity({4, 4, 4}), 34650);
}

TEST(CartesianTensor, ItsFunctionDependsOnTheSymmetricPartOnly) {
    std::mt19937 random(1);
    for (const int order : {2, 3, 4, 5, 6, 7}) {
        const std::vector<double> entries = randomValues(random, entryCount(order));
        const std::vector<double> components = symmetricPart(order, entries);
        for (int i = 0; i < 20; ++i) {
            const glm::dvec3 x = test::randomDirection(random);
            EXPECT_NEAR(evaluateTensor(order, components, x), sumOfEntries(order, entries, x), 1e-13);
        }
    }
}

TEST(CartesianTensor, FullTraceIsTheSumOverPairedIndices) {
    std::mt19937 random(2);
    const std::vector<double> entries = randomValues(random, 81);
    std::vector<double> symmetric(81);
    const std::vector<double> components = symmetricPart(4, entries);
    double paired = 0;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            const auto at = [&](int a, int b, int c, int d) {
                return entries[static_cast<std::size_t>(27 * a + 9 * b + 3 * c + d)];
            };
            paired += (at(i, i, j, j) + at(i, j, i, j) + at(i, j, j, i)) / 3;
        }
    }
    EXPECT_NEAR(fullTrace(4, components), paired, 1e-13);
    EXPECT_EQ(fullTrace(3, randomValues(random, 10)), 0);
    EXPECT_NEAR(fullTrace(2, std::vector<double>{1, 5, 6, 2, 7, 4}), 7, 1e-15);
}

TEST(CartesianTensor, TurnsAndMirrorsWithItsDirections) {
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    for (const int order : {2, 3, 4, 8, 12}) {
        glm::dmat3 matrix =
            glm::mat3_cast(glm::normalize(glm::dquat(normal(random), normal(random), normal(random), normal(random))));
        if (order % 4 == 0) matrix[1] = -matrix[1];
        const std::vector<double> before = randomValues(random, symmetricCount(order));
        std::vector<double> after = before;
        TensorRotation(order, matrix).apply(after);
        double norm = 0;
        std::size_t i = 0;
        for (const TensorPowers powers : symmetricComponents(order)) norm += multiplicity(powers) * before[i] * before[i], ++i;
        for (int n = 0; n < 20; ++n) {
            const glm::dvec3 x = test::randomDirection(random);
            EXPECT_NEAR(evaluateTensor(order, after, matrix * x), evaluateTensor(order, before, x), 1e-13 * std::sqrt(norm))
                << order;
        }
    }
    EXPECT_THROW(TensorRotation(4, glm::dmat3(2.0)), Error);
}

/// A symmetric 6x6 matrix and the quadratic form of the strain x x^T in it, which is the glyph's function.
TEST(Elasticity, EveryConventionGivesTheSameTensor) {
    std::mt19937 random(4);
    const std::vector<double> stiffness = fullMatrix(randomValues(random, 21));
    std::vector<double> compliance = stiffness, mandel = stiffness;
    for (std::size_t row = 0; row < 6; ++row) {
        for (std::size_t column = 0; column < 6; ++column) {
            const int shear = (row >= 3) + (column >= 3);
            compliance[6 * row + column] *= std::pow(2.0, shear);
            mandel[6 * row + column] *= std::pow(2.0, 0.5 * shear);
        }
    }
    const std::vector<double> expected = symmetricFromMatrix(stiffness, ElasticityConvention::kVoigtStiffness);
    const std::vector<double> from_compliance = symmetricFromMatrix(compliance, ElasticityConvention::kVoigtCompliance);
    const std::vector<double> from_mandel = symmetricFromMatrix(mandel, ElasticityConvention::kMandel);
    for (std::size_t i = 0; i < 15; ++i) {
        EXPECT_NEAR(from_compliance[i], expected[i], 1e-15);
        EXPECT_NEAR(from_mandel[i], expected[i], 1e-15);
    }
    for (int n = 0; n < 20; ++n) {
        const glm::dvec3 x = test::randomDirection(random);
        const double strain[6] = {x.x * x.x, x.y * x.y, x.z * x.z, 2 * x.y * x.z, 2 * x.x * x.z, 2 * x.x * x.y};
        double energy = 0;
        for (std::size_t i = 0; i < 36; ++i) energy += stiffness[i] * strain[i / 6] * strain[i % 6];
        EXPECT_NEAR(evaluateTensor(4, expected, x), energy, 1e-14 * 36);
    }
}

}  // namespace
}  // namespace radiata
