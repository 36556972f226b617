#include "build/volume_bricks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

#include "base/error.h"
#include "build/folded_ball.h"

namespace radiata {
namespace {

model::ScalarImage noise(const glm::ivec3& size) {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> value(-1, 1);
    model::ScalarImage image;
    image.size = size;
    image.source = "noise";
    image.values.resize(static_cast<std::size_t>(size.x) * size.y * size.z);
    for (float& v : image.values) v = value(random);
    return image;
}

/// Every cell's corners lie in the ranges of its brick and its block, and every end of a range is some corner.
void expectTight(const model::ScalarImage& image, const BrickLevel& level, int cells) {
    std::vector<glm::vec2> expected(level.ranges.size(), {1e30F, -1e30F});
    for (int k = 0; k < image.size.z - 1; ++k) {
        for (int j = 0; j < image.size.y - 1; ++j) {
            for (int i = 0; i < image.size.x - 1; ++i) {
                const glm::ivec3 box = glm::ivec3(i, j, k) / cells;
                glm::vec2& range = expected.at(static_cast<std::size_t>(box.x + level.size.x * (box.y + level.size.y * box.z)));
                for (int n = 0; n < 8; ++n) {
                    const float sample = image.at(glm::ivec3(i + (n & 1), j + (n >> 1 & 1), k + (n >> 2)));
                    range = {std::min(range.x, sample), std::max(range.y, sample)};
                }
            }
        }
    }
    EXPECT_EQ(expected, level.ranges);
}

TEST(VolumeBricks, RangesAreThoseOfTheCellsCorners) {
    for (const glm::ivec3& size : {glm::ivec3(2, 2, 2), glm::ivec3(9, 10, 65), glm::ivec3(70, 17, 8), glm::ivec3(66, 2, 130)}) {
        const model::ScalarImage image = noise(size);
        const VolumeBricks bricks = buildVolumeBricks(image);
        EXPECT_EQ(bricks.bricks.size, (size + 2) / 4);
        EXPECT_EQ(bricks.blocks.size, (size + 14) / 16);
        expectTight(image, bricks.bricks, 4);
        expectTight(image, bricks.blocks, 16);
        EXPECT_EQ(bricks.value_min, *std::ranges::min_element(image.values));
        EXPECT_EQ(bricks.value_max, *std::ranges::max_element(image.values));
        EXPECT_EQ(bricks.no_value, 0U);
    }
}

TEST(VolumeBricks, CountsVoxelsWithoutANumberAndLeavesThemOut) {
    model::ScalarImage image = noise({20, 20, 20});
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    image.values[0] = std::numeric_limits<float>::quiet_NaN();
    image.values[1] = kInfinity;
    image.values[2] = -kInfinity;
    image.values[3] = 3.3e38F;
    const VolumeBricks bricks = buildVolumeBricks(image);
    EXPECT_EQ(bricks.no_value, 4U);
    EXPECT_LT(bricks.value_max, 1);
    EXPECT_GT(bricks.value_min, -1);
    std::ranges::fill(image.values, kInfinity);
    EXPECT_EQ(buildVolumeBricks(image).no_value, 8000U);
    EXPECT_EQ(buildVolumeBricks(image).bricks.ranges[0], glm::vec2(kInfinity, -kInfinity));
}

TEST(VolumeBricks, RefusesOneSlice) {
    for (const glm::ivec3& size : {glm::ivec3(1, 1, 1), glm::ivec3(40, 40, 1), glm::ivec3(1, 40, 40)}) {
        try {
            buildVolumeBricks(noise(size));
            ADD_FAILURE() << "taken";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), Code::kInvalidArgument);
            EXPECT_THAT(error.what(), ::testing::HasSubstr("needs at least 2 along each axis"));
        }
    }
}

TEST(FoldedBall, HasTheFormulasValues) {
    const model::ScalarImage ball = foldedBall(33);
    EXPECT_EQ(ball.at({16, 16, 16}), 100.0F);  // the gyroid is 0 in its centre
    EXPECT_LT(ball.at({0, 0, 0}), 0);
    EXPECT_THROW(foldedBall(1), Error);
}

}  // namespace
}  // namespace radiata
