// Length of rays inside of a glyph on the device against the double reference: over the whole glyph, through its centre, from
// inside, with an end in the middle, on the line of ten hits of Peters et al. 2023, Fig. 2.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

#include "gpu/functions/march_runner.h"
#include "reference/glyph_bounds.h"
#include "reference/inside_length.h"
#include "shaders/test/inside_io.glsl"

namespace radiata {
namespace {

using namespace test;
using shader::InsideInput;
using shader::InsideOutput;

const std::vector<ShLayout> kLayouts{{2, false}, {4, false}, {8, false}, {16, false}, {4, true}};

struct Worst {
    int rays = 0, inside = 0;
    double error = 0, grazing_error = 0;
    std::uint32_t steps = 0;
};

class InsideFunctions : public FunctionTest {
protected:
    /// Errors in radii, apart for rays whose hits come, go or change sign when they move by 1e-5 radii.
    void compare(ShLayout layout, const std::vector<float>& glyph, const std::vector<InsideInput>& rays, Worst& worst) {
        const reference::ShFunction f(layout, glyph);
        const double radius = reference::glyphBounds(f, true).radius;
        std::vector<float> shared = glyph;
        shared.push_back(float(radius * (1 + 1e-6)));
        const auto outputs = runFunction<InsideOutput>("test_inside_" + nameOf(layout), {0}, rays, shared);
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const glm::dvec3 direction = glm::normalize(glm::dvec3(rays[i].direction));
            const bool both = rays[i].both_lobes != 0;
            const double expected =
                reference::insideLength(f, rays[i].origin, direction, double(rays[i].begin), double(rays[i].end), both);
            const double error = std::abs(double(outputs[i].length) - expected) / radius;
            EXPECT_EQ(outputs[i].capped, 0U);
            double& largest =
                reference::glyphHits(f, rays[i].origin, direction, both).grazing ? worst.grazing_error : worst.error;
            largest = std::max(largest, error);
            worst.steps = std::max(worst.steps, outputs[i].steps);
            worst.inside += expected > 0;
            ++worst.rays;
        }
    }

    /// Two glyphs of 200 rays each at distances to `farthest` from the centre, with parts between begin and end.
    Worst overGlyphs(ShLayout layout, float farthest, float begin_min, float begin_max, float end_min, float end_max) {
        std::mt19937 random(31);
        Worst worst;
        for (int g = 0; g < 2; ++g) {
            const std::vector<float> glyph = randomGlyph(random, layout);
            std::vector<InsideInput> rays;
            std::uniform_real_distribution<float> unit(0, 1);
            for (const RayInput& ray : randomRays(random, 200, 0, farthest)) {
                const float begin = begin_min + (begin_max - begin_min) * unit(random);
                const float end = std::max(begin, end_min + (end_max - end_min) * unit(random));
                rays.push_back({ray.origin, begin, ray.direction, end, ray.both_lobes});
            }
            compare(layout, glyph, rays, worst);
        }
        std::printf("%s %2d  to %g, from %g: %d rays, %d inside, worst %.2g, grazing %.2g, %u steps\n",
                    layout.full ? "full" : "even", layout.lmax, double(farthest), double(begin_min), worst.rays, worst.inside,
                    worst.error, worst.grazing_error, worst.steps);
        return worst;
    }

    static void expectGood(const Worst& worst, double bound) {
        EXPECT_GT(worst.inside, worst.rays / 8);
        EXPECT_LE(worst.error, bound);
        EXPECT_LE(worst.grazing_error, 1e-3);
    }
};

TEST_F(InsideFunctions, AreRightOverTheWholeGlyph) {
    for (const ShLayout layout : kLayouts) expectGood(overGlyphs(layout, 1, 0, 0, 6, 6), 5e-5);
}

TEST_F(InsideFunctions, AreRightThroughTheCentre) {
    for (const ShLayout layout : kLayouts) {
        expectGood(overGlyphs(layout, 0.02F, 0, 0, 6, 6), 2e-4);
        expectGood(overGlyphs(layout, 2e-4F, 0, 0, 6, 6), 2e-4);
    }
}

TEST_F(InsideFunctions, BeginInsideAndEndAtSomethingOpaque) {
    for (const ShLayout layout : kLayouts) {
        expectGood(overGlyphs(layout, 0.5F, 2.2F, 3.8F, 6, 6), 5e-5);
        expectGood(overGlyphs(layout, 0.5F, 0, 0, 2.2F, 3.8F), 5e-5);
        expectGood(overGlyphs(layout, 0.5F, 2.0F, 3.5F, 2.5F, 4.0F), 5e-5);
    }
}

TEST_F(InsideFunctions, OfAThousandthOfTheRayAddUpToAllOfIt) {
    std::mt19937 random(32);
    const ShLayout layout{8, false};
    const std::vector<float> glyph = randomGlyph(random, layout);
    const RayInput ray = randomRays(random, 1, 0.1F, 0.1F)[0];
    std::vector<InsideInput> parts;
    for (int i = 0; i < 1000; ++i)
        parts.push_back({ray.origin, 1.5F + 0.003F * float(i), ray.direction, 1.5F + 0.003F * float(i + 1), 1});
    parts.push_back({ray.origin, 1.5F, ray.direction, 4.5F, 1});
    std::vector<float> shared = glyph;
    shared.push_back(float(reference::glyphBounds(reference::ShFunction(layout, glyph), true).radius * (1 + 1e-6)));
    const auto outputs = runFunction<InsideOutput>("test_inside_even8", {0}, parts, shared);
    double sum = 0;
    for (int i = 0; i < 1000; ++i) sum += double(outputs[std::size_t(i)].length);
    EXPECT_GT(sum, 0.1);
    EXPECT_NEAR(sum, double(outputs[1000].length), 2e-4);
}

TEST_F(InsideFunctions, CountRaysThroughTheExactCentre) {
    // Along z a band-2 glyph of positive and negative lobes: inside from -|f(-z)| to |f(z)|; across, hidden lobes give nothing.
    const ShLayout layout{2, false};
    std::vector<float> glyph(layout.count(), 0.0F);
    glyph[layout.index(2, 0)] = 1;
    const reference::ShFunction f(layout, glyph);
    const float along = float(f({0, 0, 1})), across = float(-f({1, 0, 0}));
    ASSERT_GT(across, 0.1F);
    std::vector<float> shared = glyph;
    shared.push_back(along * 1.01F);
    const std::vector<InsideInput> rays{{{0, 0, -3}, 0, {0, 0, 1}, 6, 0},
                                        {{-3, 0, 0}, 0, {1, 0, 0}, 6, 1},
                                        {{-3, 0, 0}, 0, {1, 0, 0}, 6, 0},
                                        {{0, 0, 0}, 0, {0, 0, 1}, 6, 0},
                                        {{0, 0, 0}, -6, {0, 1, 0}, 0, 1}};
    const auto outputs = runFunction<InsideOutput>("test_inside_even2", {0}, rays, shared);
    const float expected[] = {2 * along, 2 * across, 0, along, across};
    for (std::size_t i = 0; i < rays.size(); ++i) EXPECT_NEAR(outputs[i].length, expected[i], 1e-5F) << i;
}

}  // namespace
}  // namespace radiata
