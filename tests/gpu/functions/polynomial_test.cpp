#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <string>

#include "gpu/functions/function_runner.h"
#include "gpu/functions/ray_comparison.h"

namespace radiata {
namespace {

using namespace test;

constexpr std::uint32_t kPaperStop = 0, kBracketStop = 1, kFirstHit = 0, kAllHits = 1;

std::string moduleOf(int lmax) { return "test_polynomial_even" + std::to_string(lmax); }

class PolynomialFunctions : public FunctionTest {
protected:
    Solve solver(int lmax, std::uint32_t stop) {
        return [this, lmax, stop](const std::vector<float>& glyph, const std::vector<RayInput>& rays) {
            return runFunction<RayOutput>(moduleOf(lmax), {stop, kFirstHit}, rays, glyph);
        };
    }
};

TEST_F(PolynomialFunctions, StopOnBracketIsExactOverTheWholeGlyph) {
    for (const int lmax : {2, 4, 6, 8, 10, 12}) {
        const Comparison result = compareRegion(solver(lmax, kBracketStop), {lmax, false}, {0.02F, 1}, 2e-5);
        EXPECT_EQ(result.wrong, 0) << lmax;
        EXPECT_GT(result.rays, 890);
    }
}

TEST_F(PolynomialFunctions, StopOnBracketIsNearlyAlwaysRightAtTheCentre) {
    // Float32 coefficients, not the stop, are the limit here; it grows with the conditioning of the Vandermonde matrix.
    for (const int lmax : {4, 8, 12}) {
        const int allowed = lmax <= 8 ? 5 : 20;
        for (const Region region : {Region{0, 0.02F}, Region{0, 2e-4F}}) {
            EXPECT_LE(compareRegion(solver(lmax, kBracketStop), {lmax, false}, region, 1e-3).wrong, allowed) << lmax;
        }
    }
}

TEST_F(PolynomialFunctions, StopOfThePaperIsRightOverTheWholeGlyphAndFailsAtTheCentre) {
    for (const int lmax : {4, 8, 12}) {
        EXPECT_LE(compareRegion(solver(lmax, kPaperStop), {lmax, false}, {0.02F, 1}, 2e-3).wrong, lmax <= 8 ? 5 : 20) << lmax;
        EXPECT_GT(compareRegion(solver(lmax, kPaperStop), {lmax, false}, {0, 2e-4F}, 1e-3).wrong, 20) << lmax;
    }
}

TEST_F(PolynomialFunctions, StartsAtTheFirstParameterAllowed) {
    for (const int lmax : {4, 8}) {
        const Comparison result = compareRegion(solver(lmax, kBracketStop), {lmax, false}, {0.02F, 0.5F}, 2e-5, true);
        EXPECT_LE(result.wrong, 1) << lmax;  // a ray that begins within rounding of the surface
    }
}

TEST_F(PolynomialFunctions, FindsEveryHitOfALine) {
    std::mt19937 random(14);
    for (const int lmax : {4, 8, 12}) {
        const std::vector<float> glyph = randomGlyph(random, {lmax, false});
        const reference::ShFunction f({lmax, false}, glyph);
        const std::vector<RayInput> rays = randomRays(random, 300, 0.05F, 0.6F);
        const auto outputs = runFunction<RayOutput>(moduleOf(lmax), {kBracketStop, kAllHits}, rays, glyph);
        int compared = 0, different = 0;
        std::size_t most = 0;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            RayInput ray = rays[i];
            ray.both_lobes = 1;
            const reference::GlyphHits expected = truth(f, ray);
            if (expected.grazing) continue;
            ++compared;
            most = std::max(most, expected.hits.size());
            different += outputs[i].count != expected.hits.size() ||
                         (!expected.hits.empty() && std::abs(outputs[i].t - expected.hits.back().t) > 1e-3);
        }
        std::printf("k %2d: %d lines, up to %zu hits, %d different\n", lmax, compared, most, different);
        EXPECT_GT(compared, 250);
        EXPECT_LE(different, lmax <= 8 ? 0 : 3) << lmax;
    }
}

TEST_F(PolynomialFunctions, SurvivesDegenerateInput) {
    std::vector<float> nothing(45, 0.0F), sphere(45, 0.0F);
    sphere[0] = 3.5449077F;  // radius 1
    const std::vector<RayInput> rays{
        {{0, 0, 3}, 0, {0, 0, -1}, 1}, {{1.5F, 0, 3}, 0, {0, 0, -1}, 1}, {{0, 0, 0}, 0, {1, 0, 0}, 1}};
    for (const RayOutput& output : runFunction<RayOutput>(moduleOf(8), {kBracketStop, kFirstHit}, rays, nothing)) {
        EXPECT_EQ(output.amplitude, 0);
    }
    const auto hits = runFunction<RayOutput>(moduleOf(8), {kBracketStop, kFirstHit}, rays, sphere);
    EXPECT_NEAR(hits[0].t, 2, 2e-5);
    EXPECT_EQ(hits[1].amplitude, 0);
    EXPECT_NEAR(hits[2].t, 1, 2e-5);
}

}  // namespace
}  // namespace radiata
