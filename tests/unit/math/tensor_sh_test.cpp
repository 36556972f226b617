// Tensors as spherical harmonics and back: the same function, in double.
#include "math/tensor_sh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

#include "base/error.h"
#include "math/cartesian_tensor.h"
#include "math/sh_evaluate.h"
#include "unit/math/sh_test_tools.h"

namespace radiata {
namespace {

TEST(TensorSh, IsTheSameFunctionInEveryOrder) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (int order = kTensorOrderMin; order <= kTensorOrderMax; ++order) {
        const TensorSh map(order);
        EXPECT_EQ(map.layout(), (ShLayout{order, order % 2 != 0}));
        double forth = 0, back = 0;
        for (int trial = 0; trial < 10; ++trial) {
            std::vector<double> components(symmetricCount(order)), coefficients(map.layout().count()), again(components.size());
            for (double& value : components) value = uniform(random);
            map.toSh(components, coefficients);
            map.toTensor(coefficients, again);
            for (std::size_t i = 0; i < again.size(); ++i) back = std::max(back, std::abs(again[i] - components[i]));
            double largest = 0, worst = 0;
            for (int n = 0; n < 50; ++n) {
                const glm::dvec3 x = test::randomDirection(random);
                const double value = evaluateTensor(order, components, x);
                largest = std::max(largest, std::abs(value));
                worst = std::max(worst, std::abs(evaluateSh(map.layout(), std::span<const double>(coefficients), x) - value));
            }
            forth = std::max(forth, worst / largest);
        }
        std::printf("order %2d: function %.1e of its largest value, components after there and back %.1e\n", order, forth,
                    back);
        EXPECT_LT(forth, 1e-13) << order;
        EXPECT_LT(back, 1e-12) << order;
    }
}

TEST(TensorSh, ConstantsAndSingleBandsAreWhatTheyShouldBe) {
    // |x|^2 as a tensor of order 2: the constant 1, which is sqrt(4 pi) Y_00.
    const TensorSh two(2);
    std::vector<double> coefficients(6);
    two.toSh(std::vector<double>{1, 0, 0, 1, 0, 1}, coefficients);
    EXPECT_NEAR(coefficients[0], std::sqrt(4 * std::numbers::pi), 1e-13);
    for (std::size_t i = 1; i < 6; ++i) EXPECT_NEAR(coefficients[i], 0, 1e-13);
    // A band of order 4 alone has no trace.
    const TensorSh four(4);
    std::vector<double> bands(15, 0.0), components(15);
    bands[ShLayout{4, false}.index(4, -3)] = 1;
    four.toTensor(bands, components);
    EXPECT_NEAR(fullTrace(4, components), 0, 1e-13);
}

TEST(TensorSh, RefusesWhatNoTensorHas) {
    EXPECT_THROW(TensorSh(1), Error);
    EXPECT_THROW(TensorSh(13), Error);
    const TensorSh three(3);
    std::vector<double> coefficients(16, 0.0), components(10);
    coefficients[0] = 1;  // band 0 in an odd tensor
    EXPECT_THROW(three.toTensor(coefficients, components), Error);
}

}  // namespace
}  // namespace radiata
