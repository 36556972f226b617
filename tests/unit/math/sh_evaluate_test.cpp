// The plain evaluator against the standard library's Legendre functions.
#include "math/sh_evaluate.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "unit/math/sh_test_tools.h"

namespace radiata {
namespace {

TEST(ShEvaluate, EqualsTheDefinitionForEveryBasisFunction) {
    // Bound 1e-13: the oracle's own error near the poles at band 16 is a few 1e-14.
    std::mt19937 random(3);
    for (const ShLayout layout : {ShLayout{0, false}, {1, true}, {7, true}, {16, true}, {2, false}, {16, false}}) {
        std::vector<double> values(layout.count());
        for (int i = 0; i < 60; ++i) {
            const glm::dvec3 d = test::randomDirection(random);
            evaluateSh(layout, d, values);
            for (int l = 0; l <= layout.lmax; l += layout.step()) {
                for (int m = -l; m <= l; ++m) {
                    EXPECT_NEAR(values[layout.index(l, m)], test::basisFunction(ShConvention::kDescoteaux07, l, m, d), 1e-13)
                        << l << ' ' << m;
                }
            }
        }
    }
}

TEST(ShEvaluate, PolesHaveOnlyZonalHarmonics) {
    const ShLayout layout{16, true};
    std::vector<double> values(layout.count());
    for (const double z : {1.0, -1.0}) {
        evaluateSh(layout, {0, 0, z}, values);
        for (int l = 0; l <= 16; ++l) {
            for (int m = -l; m <= l; ++m) {
                const double zonal = std::sqrt((2 * l + 1) / (4 * std::numbers::pi)) * (z < 0 && l % 2 != 0 ? -1 : 1);
                EXPECT_NEAR(values[layout.index(l, m)], m == 0 ? zonal : 0, 1e-14 * std::sqrt(2 * l + 1)) << l << ' ' << m;
            }
        }
    }
}

TEST(ShEvaluate, AdditionTheoremHoldsForEachBand) {
    // Sum over m of Y_lm^2 is (2 l + 1) / 4 pi in every direction: bound 1e-14 (2 l + 1).
    std::mt19937 random(4);
    const ShLayout layout{16, true};
    std::vector<double> values(layout.count());
    for (int i = 0; i < 100; ++i) {
        evaluateSh(layout, test::randomDirection(random), values);
        for (int l = 0; l <= 16; ++l) {
            double sum = 0;
            for (int m = -l; m <= l; ++m) sum += values[layout.index(l, m)] * values[layout.index(l, m)];
            EXPECT_NEAR(sum, (2 * l + 1) / (4 * std::numbers::pi), 1e-14 * (2 * l + 1));
        }
    }
}

TEST(ShEvaluate, SumsCoefficientsInFloatAndDouble) {
    std::mt19937 random(5);
    const ShLayout layout{8, false};
    const std::vector<double> exact = test::randomCoefficients(random, layout);
    const std::vector<float> rounded(exact.begin(), exact.end());
    const glm::dvec3 d = test::randomDirection(random);
    EXPECT_NEAR(evaluateSh(layout, std::span<const double>(exact), d),
                test::evaluateByDefinition(ShConvention::kDescoteaux07, layout, exact, d), 1e-13);
    EXPECT_NEAR(evaluateSh(layout, std::span<const float>(rounded), d), evaluateSh(layout, std::span<const double>(exact), d),
                1e-6);
}

TEST(ShEvaluate, RefusesBandsAboveTheLimit) {
    std::vector<double> values(18 * 18);
    EXPECT_THROW(evaluateSh({17, true}, {0, 0, 1}, values), Error);
    EXPECT_THROW(evaluateSh({16, true}, {0, 0, 1}, values), Error) << "the span must fit the layout";
}

}  // namespace
}  // namespace radiata
