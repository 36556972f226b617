// Both floats together carry 48 bits of each component, in optimised builds too.
#include "math/two_floats.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace radiata {
namespace {

TEST(TwoFloats, CarryTwiceTheBitsOfAFloat) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> mantissa(-1, 1);
    for (const double size : {1e-3, 1.0, 10.0, 1e5, 1e12}) {
        for (int i = 0; i < 1000; ++i) {
            const glm::dvec3 value = size * glm::dvec3(mantissa(random), mantissa(random), mantissa(random));
            const TwoFloats sum = twoFloats(value);
            for (int axis = 0; axis < 3; ++axis) {
                const double left = value[axis] - static_cast<double>(sum.high[axis]) - static_cast<double>(sum.low[axis]);
                EXPECT_LE(std::abs(left), std::abs(value[axis]) * std::ldexp(1.0, -48)) << value[axis];
            }
        }
    }
}

TEST(TwoFloats, ComponentsDoNotDependOnEachOther) {
    const TwoFloats sum = twoFloats({0.25, 10.000010999999999, 0});
    EXPECT_EQ(sum.high, glm::vec3(0.25F, 10.0000114F, 0));
    EXPECT_NEAR(sum.low.y, -4.44091796e-07, 1e-14);
    EXPECT_EQ(sum.low.x, 0.0F);
}

}  // namespace
}  // namespace radiata
