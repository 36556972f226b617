// How drawn layers carry ray parameters and normals. Depths: lossless and in the order of the parameters, so the depth test of
// images decides as floats do. Normals: the octahedral pair against its inverse in double, to 3e-7.
#include <algorithm>
#include <bit>
#include <cmath>
#include <random>

#include "gpu/functions/function_runner.h"
#include "shaders/test/raster_codes_io.glsl"

namespace radiata {
namespace {

using shader::RasterCodesInput;
using shader::RasterCodesOutput;
using RasterCodes = test::FunctionTest;

/// The number of a float among the floats of magnitude 2^-31 to 2^31 in ascending order, 0 for zero: counted by exponent and
/// fraction.
std::int64_t number(double t) {
    if (std::abs(t) < std::ldexp(1.0, -31)) return 0;
    int exponent = 0;
    const double fraction = std::frexp(std::abs(t), &exponent);  // 0.5 to 1
    const auto within = static_cast<std::int64_t>(std::ldexp(fraction - 0.5, 24));
    const std::int64_t n = (std::int64_t{exponent} + 30) * (1 << 23) + within + 1;
    return t < 0 ? -n : n;
}

TEST_F(RasterCodes, CarryParametersAsDepthsWithoutLoss) {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> power(-30.9F, 30.9F), sign(-1, 1);
    std::vector<RasterCodesInput> inputs;
    for (int i = 0; i < 20000; ++i) inputs.push_back({std::copysign(std::exp2(power(random)), sign(random)), {0, 0, 1}});
    // Neighbouring floats of both signs, about a plain value, the ends and zero.
    for (const float start : {1.0F, 0.9999999F, std::exp2(-31.0F), std::exp2(30.9999F), 37.25F}) {
        float t = start;
        for (int i = 0; i < 20; ++i, t = std::nextafter(t, 1e9F)) {
            inputs.push_back({t, {0, 0, 1}});
            inputs.push_back({-t, {0, 0, 1}});
        }
    }
    inputs.push_back({0.0F, {0, 0, 1}});
    std::ranges::sort(inputs, {}, &RasterCodesInput::t);
    const auto outputs = runFunction<RasterCodesOutput>("test_raster_codes", {}, inputs);
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        ASSERT_EQ(outputs[i].t, inputs[i].t);
        ASSERT_GT(outputs[i].depth, 0);
        ASSERT_LE(outputs[i].depth, 0.5F);
        ASSERT_TRUE(std::isnormal(outputs[i].depth));
        ASSERT_EQ(0x20000000 - std::bit_cast<std::int32_t>(outputs[i].depth), number(double(inputs[i].t)));
        if (i > 0 && inputs[i].t > inputs[i - 1].t) {
            ASSERT_LT(outputs[i].depth, outputs[i - 1].depth);
        }
    }
}

TEST_F(RasterCodes, BoundParametersThatAreOutOfRange) {
    const std::vector<float> values{1e-12F, -1e-12F, 1e12F, -1e12F};
    std::vector<RasterCodesInput> inputs;
    for (const float value : values) inputs.push_back({value, {0, 0, 1}});
    const auto outputs = runFunction<RasterCodesOutput>("test_raster_codes", {}, inputs);
    EXPECT_EQ(outputs[0].t, 0);
    EXPECT_EQ(outputs[1].t, 0);
    EXPECT_NEAR(double(outputs[2].t), 2147483648.0, 256);
    EXPECT_NEAR(double(outputs[3].t), -2147483648.0, 256);
}

TEST_F(RasterCodes, CarryNormalsAsPairs) {
    std::mt19937 random(6);
    std::normal_distribution<double> normal;
    std::vector<RasterCodesInput> inputs;
    for (int i = 0; i < 20000; ++i) {
        glm::dvec3 n(normal(random), normal(random), normal(random));
        if (i % 10 == 0) n[i / 10 % 3] = 0;
        if (i % 100 == 0) n = glm::dvec3(i % 300 == 0, i % 300 == 100, i % 300 == 200) * (i % 200 == 0 ? 1.0 : -1.0);
        inputs.push_back({1, glm::vec3(glm::normalize(n))});
    }
    const auto outputs = runFunction<RasterCodesOutput>("test_raster_codes", {}, inputs);
    double worst = 0, worst_pair = 0;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        const glm::dvec3 n(inputs[i].normal);
        worst = std::max(worst, glm::length(glm::dvec3(outputs[i].normal) - n));
        // Twin: the point where the octahedron is met, its lower half mirrored along the edges of the square.
        const double sum = std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
        glm::dvec2 pair(n.x / sum, n.y / sum);
        if (n.z < 0) {
            const double x = pair.x, y = pair.y;
            pair = {std::copysign(1 - std::abs(y), x), std::copysign(1 - std::abs(x), y)};
            // On the seams both signs name the same direction.
            if (x == 0) pair.x = std::copysign(pair.x, double(outputs[i].pair.x));
            if (y == 0) pair.y = std::copysign(pair.y, double(outputs[i].pair.y));
        }
        worst_pair = std::max(worst_pair, glm::length(glm::dvec2(outputs[i].pair) - pair));
    }
    std::printf("normals off by %.2g at most, pairs by %.2g\n", worst, worst_pair);
    EXPECT_LT(worst, 3e-7);
    EXPECT_LT(worst_pair, 3e-7);
}

}  // namespace
}  // namespace radiata
