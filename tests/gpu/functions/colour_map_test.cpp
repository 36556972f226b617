// Colour maps on the device against their twin.
#include "reference/colour_map.h"

#include <algorithm>
#include <random>

#include "gpu/functions/function_runner.h"
#include "math/colour_map.h"

namespace radiata {
namespace {

using ColourMapFunctions = test::FunctionTest;

struct ColourInput {
    float value, low, high;
};

/// Within, at and beyond the ends, ranges of either sign and from 1e-6 to 1e6 wide. A table step carries at most 0.06 of linear
/// light, and the place in the table is exact to 255 roundings of the value against the range.
TEST_F(ColourMapFunctions, AgreeWithTheirTwin) {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> unit(-0.25F, 1.25F), exponent(-6, 6), sign(-1, 1);
    std::vector<ColourInput> inputs;
    for (int i = 0; i < 6000; ++i) {
        const float width = std::pow(10.0F, exponent(random)), low = width * sign(random), high = low + width;
        const float values[] = {low + unit(random) * (high - low), low, high};
        inputs.push_back({values[i % 3], low, high});
    }
    for (const ColourMap map :
         {ColourMap::kViridis, ColourMap::kInferno, ColourMap::kCividis, ColourMap::kBlackRedYellow, ColourMap::kGrey}) {
        const ColourTable& table = linearColourTable(map);
        std::vector<float> shared;
        for (const glm::vec3& colour : table) shared.insert(shared.end(), {colour.x, colour.y, colour.z});
        const auto outputs = runFunction<glm::vec3>("test_colour_map", {}, inputs, shared);
        double worst = 0;
        for (std::size_t i = 0; i < inputs.size(); ++i) {
            const glm::dvec3 expected = reference::mappedColour(table, inputs[i].value, inputs[i].low, inputs[i].high);
            for (int c = 0; c < 3; ++c) worst = std::max(worst, std::abs(static_cast<double>(outputs[i][c]) - expected[c]));
        }
        EXPECT_LT(worst, 2e-5) << name(map);
        RecordProperty(std::string(name(map)), std::to_string(worst));
    }
}

}  // namespace
}  // namespace radiata
