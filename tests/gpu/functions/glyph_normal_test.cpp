// Normals on the device within 0.1 degree of those of the reference, in every direction in which the surface has one: where f
// and its slope both vanish it has none. Where only f vanishes, its sign, and so the normal's, is for rounding to say: the
// renderer turns normals towards the viewer.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "gpu/functions/march_runner.h"

namespace radiata {
namespace {

using GlyphNormalFunctions = test::FunctionTest;

TEST_F(GlyphNormalFunctions, AgreeWithTheirTwin) {
    std::mt19937 random(20);
    std::normal_distribution<float> normal;
    for (const ShLayout layout : {ShLayout{4, false}, ShLayout{8, false}, ShLayout{12, false}, ShLayout{16, false},
                                  ShLayout{4, true}, ShLayout{16, true}}) {
        double worst = 0;
        int compared = 0;
        for (int glyphs = 0; glyphs < 5; ++glyphs) {
            const std::vector<float> glyph = test::randomGlyph(random, layout);
            const reference::ShFunction f(layout, glyph);
            std::vector<glm::vec3> directions{{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {0, -1, 0}};
            while (directions.size() < 400) {
                directions.push_back(glm::normalize(glm::vec3(normal(random), normal(random), normal(random))));
            }
            const auto normals = runFunction<glm::vec3>("test_glyph_normal_" + test::nameOf(layout), {}, directions, glyph);
            for (std::size_t i = 0; i < directions.size(); ++i) {
                const glm::dvec3 p = glm::normalize(glm::dvec3(directions[i]));
                if (std::abs(f(p)) + glm::length(f.gradient(p)) < 1e-2) continue;
                ++compared;
                const glm::dvec3 found(normals[i]), expected = reference::glyphNormal(f, p);
                const double turned = glm::length(found - expected);
                worst = std::max(worst, std::abs(f(p)) < 1e-5 ? std::min(turned, glm::length(found + expected)) : turned);
            }
        }
        const double degrees = worst * 180 / std::numbers::pi;
        std::printf("%s: %d normals, off by %.2g degrees at most\n", test::nameOf(layout).c_str(), compared, degrees);
        EXPECT_GT(compared, 1900);
        EXPECT_LT(degrees, 0.1) << test::nameOf(layout);
    }
}

}  // namespace
}  // namespace radiata
