// The four conventions against their definition: converting leaves the function as it is.
#include "math/sh_convention.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "math/sh_evaluate.h"
#include "unit/math/sh_test_tools.h"

namespace radiata {
namespace {

constexpr ShConvention kAll[] = {ShConvention::kDescoteaux07, ShConvention::kDescoteaux07Legacy, ShConvention::kTournier07,
                                 ShConvention::kMrtrix02};

TEST(ShConvention, ConvertingLeavesTheFunctionAsItIs) {
    // Bound: 1e-12 absolute for coefficients in [-1, 1], band 16 (values reach about 10).
    std::mt19937 random(1);
    for (const bool full : {false, true}) {
        const ShLayout layout{16, full};
        for (const ShConvention from : kAll) {
            for (const ShConvention to : kAll) {
                const std::vector<double> original = test::randomCoefficients(random, layout);
                std::vector<double> converted = original;
                convertSh(std::span<double>(converted), layout, from, to);
                for (int i = 0; i < 5; ++i) {
                    const glm::dvec3 d = test::randomDirection(random);
                    EXPECT_NEAR(test::evaluateByDefinition(from, layout, original, d),
                                test::evaluateByDefinition(to, layout, converted, d), 1e-12)
                        << name(from) << " to " << name(to);
                }
            }
        }
    }
}

TEST(ShConvention, ThereAndBackGivesTheSameFloats) {
    std::mt19937 random(2);
    const ShLayout layout{8, false};
    for (const ShConvention from : {ShConvention::kDescoteaux07Legacy, ShConvention::kTournier07}) {
        std::vector<float> original(layout.count());
        for (float& value : original) value = std::uniform_real_distribution<float>(-1, 1)(random);
        std::vector<float> there = original;
        convertSh(std::span<float>(there), layout, from, ShConvention::kDescoteaux07);
        EXPECT_NE(there, original);
        convertSh(std::span<float>(there), layout, ShConvention::kDescoteaux07, from);
        EXPECT_EQ(there, original) << "signs and order only: exact";
    }
}

TEST(ShConvention, DescoteauxLegacyAndTournierDifferByTheOrderOfM) {
    const ShLayout layout{2, false};
    std::vector<double> c{0, 1, 2, 3, 4, 5};
    convertSh(std::span<double>(c), layout, ShConvention::kDescoteaux07Legacy, ShConvention::kTournier07);
    EXPECT_EQ(c, (std::vector<double>{0, 5, 4, 3, 2, 1}));
}

TEST(ShConvention, NamesRoundTripAndUnknownOnesListTheRightOnes) {
    for (const ShConvention convention : kAll) EXPECT_EQ(shConventionFromName(name(convention)), convention);
    EXPECT_EQ(shAxesFromName("world"), ShAxes::kWorld);
    EXPECT_EQ(shAxesFromName(name(ShAxes::kVoxel)), ShAxes::kVoxel);
    try {
        shConventionFromName("tournier");
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), Code::kInvalidArgument);
        EXPECT_NE(std::string(error.what()).find("tournier07"), std::string::npos);
    }
    EXPECT_THROW(shAxesFromName("scanner"), Error);
}

TEST(ShConvention, WrongNumberOfCoefficientsIsOurBug) {
    std::vector<double> c(5);
    EXPECT_THROW(convertSh(std::span<double>(c), {2, false}, kAll[0], kAll[2]), Error);
}

}  // namespace
}  // namespace radiata
