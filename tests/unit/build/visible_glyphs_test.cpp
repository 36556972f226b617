// What a camera sees of glyphs, in which order, and how drawing is cut into parts.
#include "build/visible_glyphs.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace radiata {
namespace {

constexpr int kWidth = 200, kHeight = 120;

/// Looks along -z from 100 mm (perspective) or in parallel; a pixel is half a millimetre at the reference.
shader::CameraRays camera(bool perspective) {
    shader::CameraRays rays{};
    rays.step_right = {0.5F, 0, 0};
    rays.step_up = {0, 0.5F, 0};
    rays.forward = {0, 0, -1};
    rays.inverse_distance = perspective ? 0.01F : 0.0F;
    rays.near_depth = -99;
    rays.far_depth = 200;
    return rays;
}

shader::GlyphInstance glyphAt(const glm::vec3& centre, float radius) {
    shader::GlyphInstance glyph{};
    glyph.centre_high = centre;
    glyph.radius = radius;
    glyph.box_min = glm::vec3(-radius);
    glyph.box_max = glm::vec3(radius);
    return glyph;
}

TEST(VisibleGlyphs, KeepsEveryGlyphThatSomePixelMeetsNearestFirst) {
    std::mt19937 random(4);
    std::uniform_real_distribution<float> place(-120, 120), size(0.1F, 3);
    for (const bool perspective : {false, true}) {
        const shader::CameraRays rays = camera(perspective);
        std::vector<shader::GlyphInstance> glyphs;
        for (int i = 0; i < 3000; ++i) glyphs.push_back(glyphAt({place(random), place(random), place(random)}, size(random)));
        const VisibleGlyphs visible = visibleGlyphs(glyphs, rays, kWidth, kHeight);
        ASSERT_EQ(visible.order.size(), visible.pixels.size());
        EXPECT_GT(visible.order.size(), 50U);
        EXPECT_LT(visible.order.size(), 2500U);
        for (std::size_t i = 1; i < visible.order.size(); ++i) {
            EXPECT_GE(glyphs[visible.order[i - 1]].centre_high.z, glyphs[visible.order[i]].centre_high.z);
        }
        // Every corner that projects into the picture lies in the rectangle of its glyph.
        for (std::uint32_t i = 0; i < glyphs.size(); ++i) {
            const auto found = std::ranges::find(visible.order, i);
            for (int corner = 0; corner < 8; ++corner) {
                const glm::dvec3 p =
                    glm::dvec3(glyphs[i].centre_high) +
                    double(glyphs[i].radius) * glm::dvec3(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
                const double depth = -p.z, nearness = perspective ? 1 + depth / 100 : 1;
                if (depth < -99 || depth > 200 || nearness <= 0) continue;
                const double x = kWidth / 2.0 + p.x / 0.5 / nearness, y = kHeight / 2.0 - p.y / 0.5 / nearness;
                if (x < 0 || y < 0 || x >= kWidth || y >= kHeight) continue;
                ASSERT_NE(found, visible.order.end()) << i;
                const PixelRect& rect = visible.pixels[std::size_t(found - visible.order.begin())];
                EXPECT_TRUE(rect.x0 <= x && x <= rect.x1 + 1 && rect.y0 <= y && y <= rect.y1 + 1) << i;
            }
        }
    }
}

TEST(VisibleGlyphs, AreDrawnInPartsThatCoverAllRowsOfAllOnce) {
    VisibleGlyphs visible;
    std::mt19937 random(9);
    for (std::uint32_t i = 0; i < 300; ++i) {
        const int x0 = int(random() % 150), y0 = int(random() % 100), side = i % 50 == 0 ? 100 : int(random() % 12);
        visible.order.push_back(i);
        visible.pixels.push_back({x0, y0, std::min(x0 + side, kWidth - 1), std::min(y0 + side, kHeight - 1)});
    }
    for (const double wanted : {1.0, 100.0, 1000.0, 1e9}) {
        for (const std::uint32_t count_max : {7U, 100'000U}) {
            std::vector<std::vector<int>> times(visible.order.size(), std::vector<int>(kHeight, 0));
            std::uint32_t next = 0, row = 0;
            double work = 0;
            int parts = 0;
            while (next < visible.order.size()) {
                const DrawPart part = nextPart(visible, next, row, wanted, 4, count_max, kHeight);
                ASSERT_GE(part.count, 1U);
                ASSERT_LE(part.count, count_max);
                ASSERT_GE(part.rows, 1U);
                ASSERT_LE(part.first_row + part.rows, std::uint32_t(kHeight));
                if (part.rows < std::uint32_t(kHeight)) {
                    ASSERT_EQ(part.count, 1U);
                }
                for (std::uint32_t i = part.first; i < part.first + part.count; ++i) {
                    for (std::uint32_t y = part.first_row; y < part.first_row + part.rows; ++y) ++times[i][y];
                }
                // Never more than wanted, except for what cannot be cut: one row of one glyph.
                EXPECT_LE(part.work, std::max(wanted * 1.0001, 300.0));
                work += part.work;
                ++parts;
                row = part.first_row + part.rows;
                if (row < std::uint32_t(kHeight)) continue;
                row = 0;
                next += part.count;
            }
            for (const auto& rows : times) {
                for (const int t : rows) ASSERT_EQ(t, 1);
            }
            double all = 0;
            for (const PixelRect& rect : visible.pixels) all += rect.area() + 4;
            EXPECT_NEAR(work, all, 0.02 * all);
            if (wanted == 1e9) {
                EXPECT_EQ(parts, count_max == 7 ? 43 : 1);
            }
        }
    }
}

}  // namespace
}  // namespace radiata
