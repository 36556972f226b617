// Colour maps have their published ends, and the uniform ones rise steadily in lightness.
#include "math/colour_map.h"

#include <cmath>

#include <gtest/gtest.h>

namespace radiata {
namespace {

glm::ivec3 bytes(const glm::vec3& colour) {
    return {std::lround(255 * colour.x), std::lround(255 * colour.y), std::lround(255 * colour.z)};
}

/// CIE L* of linear sRGB.
double lightness(const glm::vec3& colour) {
    const double y = 0.2126 * colour.x + 0.7152 * colour.y + 0.0722 * colour.z;
    return y > 216.0 / 24389 ? 116 * std::cbrt(y) - 16 : y * 24389 / 27;
}

TEST(ColourMap, HasThePublishedEnds) {
    const struct {
        ColourMap map;
        glm::ivec3 first, middle, last;
    } cases[] = {
        {ColourMap::kViridis, {68, 1, 84}, {33, 145, 140}, {253, 231, 37}},
        {ColourMap::kInferno, {0, 0, 4}, {188, 55, 84}, {252, 255, 164}},
        {ColourMap::kCividis, {0, 34, 78}, {125, 124, 120}, {254, 232, 56}},
        {ColourMap::kBlackRedYellow, {0, 0, 0}, {255, 1, 0}, {255, 255, 0}},
        {ColourMap::kGrey, {0, 0, 0}, {128, 128, 128}, {255, 255, 255}},
    };
    for (const auto& c : cases) {
        EXPECT_EQ(bytes(colourTable(c.map).front()), c.first) << name(c.map);
        EXPECT_EQ(bytes(colourTable(c.map)[128]), c.middle) << name(c.map);
        EXPECT_EQ(bytes(colourTable(c.map).back()), c.last) << name(c.map);
    }
}

/// The maps are even in CAM02-UCS, beside which L* runs flatter near black; 8 bits leave 0.04 of a step over eight of them.
TEST(ColourMap, UniformMapsRiseSteadilyInLightness) {
    for (const ColourMap map : {ColourMap::kViridis, ColourMap::kInferno, ColourMap::kCividis}) {
        const ColourTable& table = linearColourTable(map);
        const double mean = (lightness(table.back()) - lightness(table.front())) / 255;
        for (std::size_t i = 0; i + 8 < table.size(); ++i) {
            const double step = (lightness(table[i + 8]) - lightness(table[i])) / 8;
            EXPECT_GT(step, mean / 3) << name(map) << " " << i;
            EXPECT_LT(step, mean * 5 / 3) << name(map) << " " << i;
        }
    }
}

TEST(ColourMap, LinearTablesDecodeTheirSrgb) {
    for (const ColourMap map : {ColourMap::kViridis, ColourMap::kBlackRedYellow, ColourMap::kGrey}) {
        for (std::size_t i = 0; i < 256; ++i) {
            for (int c = 0; c < 3; ++c) {
                const double x = colourTable(map)[i][c];
                const double expected = x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
                EXPECT_NEAR(linearColourTable(map)[i][c], expected, 1e-6);
            }
        }
    }
}

}  // namespace
}  // namespace radiata
