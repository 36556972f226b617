// The recursion of Ivanic and Ruedenberg and Euler angles against rotation by projection.
#include "math/sh_rotation_recursive.h"

#include <random>

#include <gtest/gtest.h>
#include <glm/gtc/quaternion.hpp>

#include "base/error.h"
#include "math/sh_rotation.h"
#include "unit/math/sh_test_tools.h"

namespace radiata {
namespace {

using Method = BandMatrices (*)(int, const glm::dmat3&);

double worstDifference(Method method, int lmax, const glm::dmat3& rotation, std::mt19937& random) {
    const ShLayout layout{lmax, true};
    std::vector<double> expected = test::randomCoefficients(random, layout), found = expected;
    ShRotation(layout, rotation).apply(expected);
    applyBands(method(lmax, rotation), found);
    double worst = 0;
    for (std::size_t i = 0; i < found.size(); ++i) worst = std::max(worst, std::abs(found[i] - expected[i]));
    return worst;
}

TEST(ShRotationRecursive, BothWaysAgreeWithProjection) {
    std::mt19937 random(12);
    std::normal_distribution<double> normal;
    for (const Method method : {&ivanicRuedenberg, &zyzRotation}) {
        for (const int lmax : {0, 1, 2, 4, 8, 16}) {
            for (int i = 0; i < 4; ++i) {
                const glm::dquat turn(normal(random), normal(random), normal(random), normal(random));
                EXPECT_LT(worstDifference(method, lmax, glm::mat3_cast(glm::normalize(turn)), random), 1e-12) << lmax;
            }
        }
    }
}

TEST(ShRotationRecursive, AnglesThatAreNotUniqueAreNoSpecialCase) {
    std::mt19937 random(13);
    const glm::dmat3 about_z = glm::mat3_cast(glm::angleAxis(0.7, glm::dvec3(0, 0, 1)));
    const glm::dmat3 half_turn = glm::mat3_cast(glm::angleAxis(3.14159265358979323846, glm::dvec3(1, 0, 0)));
    for (const glm::dmat3& rotation : {glm::dmat3(1.0), about_z, half_turn, half_turn * about_z, about_z * half_turn}) {
        EXPECT_LT(worstDifference(&zyzRotation, 6, rotation, random), 1e-12);
        EXPECT_LT(worstDifference(&ivanicRuedenberg, 6, rotation, random), 1e-12);
    }
}

TEST(ShRotationRecursive, RefusesWhatIsNoRotation) {
    for (const Method method : {&ivanicRuedenberg, &zyzRotation}) {
        EXPECT_THROW(method(2, glm::dmat3(2.0)), Error);
        EXPECT_THROW(method(2, glm::dmat3(-1.0)), Error) << "a reflection";
    }
    std::vector<double> wrong(5);
    EXPECT_THROW(applyBands(ivanicRuedenberg(1, glm::dmat3(1.0)), wrong), Error);
}

}  // namespace
}  // namespace radiata
