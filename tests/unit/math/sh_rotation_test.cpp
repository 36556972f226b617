// Turned functions against the same function looked up along turned directions.
#include "math/sh_rotation.h"

#include <gtest/gtest.h>
#include <glm/gtc/quaternion.hpp>

#include "base/error.h"
#include "math/sh_evaluate.h"
#include "unit/math/sh_test_tools.h"

namespace radiata {
namespace {

glm::dmat3 randomRotation(std::mt19937& random) {
    std::normal_distribution<double> normal;
    return glm::mat3_cast(glm::normalize(glm::dquat(normal(random), normal(random), normal(random), normal(random))));
}

/// Largest |g(Q d) - f(d)| over directions.
double worstError(ShLayout layout, const glm::dmat3& q, std::mt19937& random) {
    const std::vector<double> f = test::randomCoefficients(random, layout);
    std::vector<double> g = f;
    ShRotation(layout, q).apply(g);
    double worst = 0;
    for (int i = 0; i < 50; ++i) {
        const glm::dvec3 d = test::randomDirection(random);
        const double difference =
            evaluateSh(layout, std::span<const double>(g), q * d) - evaluateSh(layout, std::span<const double>(f), d);
        worst = std::max(worst, std::abs(difference));
    }
    return worst;
}

TEST(ShRotation, TurnsFunctionsOfEveryLayout) {
    // Bound 1e-12 for coefficients in [-1, 1]: values reach about 10 at band 16.
    std::mt19937 random(6);
    for (const ShLayout layout : {ShLayout{0, false}, {2, false}, {8, false}, {16, false}, {1, true}, {5, true}, {16, true}}) {
        for (int i = 0; i < 3; ++i) EXPECT_LT(worstError(layout, randomRotation(random), random), 1e-12) << layout.lmax;
    }
}

TEST(ShRotation, MirrorsAsWellAsItTurns) {
    std::mt19937 random(7);
    for (int axis = 0; axis < 3; ++axis) {
        glm::dmat3 flip(1.0);
        flip[axis][axis] = -1;
        EXPECT_LT(worstError({16, true}, flip, random), 1e-12);
        EXPECT_LT(worstError({16, true}, flip * randomRotation(random), random), 1e-12);
    }
    EXPECT_LT(worstError({9, true}, glm::dmat3(-1.0), random), 1e-12) << "point reflection negates odd bands";
}

TEST(ShRotation, QuarterTurnsMoveALobeFromAxisToAxis) {
    const ShLayout layout{8, false};
    std::vector<double> lobe(layout.count());
    evaluateSh(layout, {1, 0, 0}, lobe);  // the sharpest function of these bands, peak along x
    const glm::dmat3 x_to_y(glm::dvec3(0, 1, 0), glm::dvec3(-1, 0, 0), glm::dvec3(0, 0, 1));
    ShRotation(layout, x_to_y).apply(lobe);
    std::vector<double> expected(layout.count());
    evaluateSh(layout, {0, 1, 0}, expected);
    for (std::size_t i = 0; i < lobe.size(); ++i) EXPECT_NEAR(lobe[i], expected[i], 1e-13);
}

TEST(ShRotation, TwoTurnsAreOne) {
    std::mt19937 random(8);
    const ShLayout layout{12, true};
    const glm::dmat3 a = randomRotation(random), b = randomRotation(random);
    std::vector<double> step_by_step = test::randomCoefficients(random, layout);
    std::vector<double> at_once = step_by_step;
    ShRotation(layout, a).apply(step_by_step);
    ShRotation(layout, b).apply(step_by_step);
    ShRotation(layout, b * a).apply(at_once);
    for (std::size_t i = 0; i < at_once.size(); ++i) EXPECT_NEAR(step_by_step[i], at_once[i], 1e-12);
}

TEST(ShRotation, RefusesWhatIsNotOrthogonal) {
    EXPECT_THROW(ShRotation({4, false}, glm::dmat3(2.0)), Error);
    EXPECT_THROW(ShRotation({4, false}, glm::dmat3(std::nan(""))), Error);
    std::vector<double> wrong(14);
    EXPECT_THROW(ShRotation({4, false}, glm::dmat3(1.0)).apply(wrong), Error);
}

}  // namespace
}  // namespace radiata
