// Bright pixels of an environment map: the table gives back the weights that it was made from.
#include "build/bright_pixels.h"

#include <cmath>
#include <map>
#include <numbers>

#include <gtest/gtest.h>

namespace radiata {
namespace {

TEST(BrightPixels, OfAnEvenMapAreNone) {
    const model::EnvironmentMap map{8, 4, std::vector<glm::vec3>(32, glm::vec3(0.7F)), "", {}};
    const BrightPixels bright = brightPixels(map);
    EXPECT_TRUE(bright.table.empty());
    EXPECT_EQ(bright.weight, 0);
    EXPECT_NEAR(bright.cap, 2.8, 1e-6);
}

TEST(BrightPixels, AreChosenByWhatTheyHaveAboveTheCap) {
    model::EnvironmentMap map{16, 8, std::vector<glm::vec3>(128, glm::vec3(0.1F)), "", {}};
    // Grey, so luminance is the value.
    const std::map<std::uint32_t, float> suns{{20, 9.0F}, {40, 30.0F}, {41, 1.0F}, {100, 60.0F}};
    for (const auto& [pixel, value] : suns) map.pixels[pixel] = glm::vec3(value);
    const BrightPixels bright = brightPixels(map);
    ASSERT_EQ(bright.table.size(), 3u) << "one of them is below the cap of " << bright.cap;
    std::map<std::uint32_t, double> chance;
    for (const shader::BrightPixel& entry : bright.table) {
        EXPECT_GE(entry.keep, 0);
        EXPECT_LE(entry.keep, 1);
        chance[entry.pixel] += static_cast<double>(entry.keep) / 3;
        chance[entry.other] += (1 - static_cast<double>(entry.keep)) / 3;
    }
    for (const auto& [pixel, probability] : chance) {
        const int row = static_cast<int>(pixel) / 16;
        constexpr double kStep = std::numbers::pi / 8;
        const double area = 2 * std::numbers::pi / 16 * (std::cos(kStep * row) - std::cos(kStep * (row + 1)));
        const double above = static_cast<double>(suns.at(pixel) - bright.cap) * area;
        EXPECT_NEAR(probability, above / bright.weight, 1e-6) << pixel;
    }
}

}  // namespace
}  // namespace radiata
