// Whole numbers, places of pixels and bytes of colours that shaders make without conversions and divisions of integers: all
// exact, against integers and doubles.
#include <cmath>
#include <random>

#include "gpu/functions/function_runner.h"
#include "shaders/test/whole_numbers_io.glsl"

namespace radiata {
namespace {

using shader::WholeNumbersInput;
using shader::WholeNumbersOutput;
using WholeNumbers = test::FunctionTest;

/// Of a colour outside 0 to 1 the nearest end.
std::uint32_t byteOf(float encoded) {
    const float scaled = std::min(std::max(encoded, 0.0F), 1.0F) * 255.0F;
    return static_cast<std::uint32_t>(std::nearbyint(double{scaled}));
}

TEST_F(WholeNumbers, AreExact) {
    std::mt19937 random(8);
    std::uniform_int_distribution<std::uint32_t> any_width(1, 16384), any_row(0, (1U << 20) - 1);
    std::uniform_real_distribution<float> any(-4194304.0F, 4194304.0F), colour(-0.1F, 1.1F);
    std::vector<WholeNumbersInput> inputs;
    for (int i = 0; i < 200000; ++i) {
        // Rows' first and last columns are the hard ones.
        const std::uint32_t width = any_width(random);
        const std::uint64_t rows = std::min<std::uint64_t>(1U << 20, (std::uint64_t{1} << 31) / width);
        const auto first = static_cast<std::uint32_t>(any_row(random) % rows * width);
        const std::uint32_t column = i % 3 == 0 ? 0 : i % 3 == 1 ? width - 1 : any_width(random) % width;
        // Halves have two whole numbers as near.
        const float x = i % 4 == 0 ? std::floor(any(random) / 4) + 0.5F : any(random);
        const float byte = (static_cast<float>(i % 256) + 0.5F) / 255.0F;
        inputs.push_back({first + column, width, x, {byte, colour(random), static_cast<float>(i % 256) / 255.0F}});
    }
    const auto outputs = runFunction<WholeNumbersOutput>("test_whole_numbers", {}, inputs);
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        const WholeNumbersInput& in = inputs[i];
        ASSERT_EQ(outputs[i].row, in.at / in.width) << in.at << " by " << in.width;
        ASSERT_EQ(outputs[i].column, in.at % in.width) << in.at << " by " << in.width;
        ASSERT_EQ(outputs[i].number, static_cast<std::int32_t>(std::nearbyint(double{in.x}))) << in.x;
        ASSERT_EQ(outputs[i].colour, byteOf(in.colour.x) | byteOf(in.colour.y) << 8 | byteOf(in.colour.z) << 16 | 0xff000000U)
            << i;
    }
}

}  // namespace
}  // namespace radiata
