#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <random>
#include <string>

#include "gpu/functions/function_runner.h"
#include "reference/glyph_hits.h"
#include "shaders/test/ray_io.glsl"

namespace radiata {
namespace {

using shader::RayInput;
using shader::RayOutput;

constexpr std::uint32_t kPaperStop = 0, kBracketStop = 1, kFirstHit = 0, kAllHits = 1;

using Solve = std::function<std::vector<RayOutput>(const std::vector<float>& glyph, const std::vector<RayInput>& rays)>;

/// A glyph of amplitude about 1: even bands, falling coefficients, mostly positive.
std::vector<float> randomGlyph(std::mt19937& random, int lmax) {
    std::uniform_real_distribution<float> unit(-1, 1);
    const ShLayout layout{lmax, false};
    std::vector<float> coefficients(layout.count());
    for (int l = 0; l <= lmax; l += 2) {
        for (int m = -l; m <= l; ++m) coefficients[layout.index(l, m)] = unit(random) / float(1 + l);
    }
    coefficients[0] = 0.6F;
    return coefficients;
}

/// Rays from distance 3 that pass the centre at `nearest` to `farthest`.
std::vector<RayInput> randomRays(std::mt19937& random, std::size_t count, float nearest, float farthest) {
    std::normal_distribution<float> normal;
    std::uniform_real_distribution<float> unit(0, 1);
    std::vector<RayInput> rays(count);
    for (RayInput& ray : rays) {
        ray.direction = glm::normalize(glm::vec3(normal(random), normal(random), normal(random)));
        const glm::vec3 side = glm::normalize(glm::cross(ray.direction, glm::vec3(normal(random), normal(random), 1)));
        ray.origin = -3.0F * ray.direction + (nearest + (farthest - nearest) * unit(random)) * side;
        ray.t_min = 0;
        ray.both_lobes = unit(random) < 0.5F;
    }
    return rays;
}

reference::GlyphHits truth(const reference::ShFunction& f, const RayInput& ray) {
    return reference::glyphHits(f, ray.origin, glm::normalize(glm::dvec3(ray.direction)), ray.both_lobes != 0, ray.t_min);
}

struct Comparison {
    int rays = 0;
    int wrong = 0;  // missed, invented, of the wrong sign, or off by more than the bound
    double worst = 0;
};

/// Leaves out rays whose first hit moves by more than 1e-3 radii when the ray moves by 1e-5.
Comparison compare(const std::vector<float>& glyph, int lmax, const std::vector<RayInput>& rays,
                   const std::vector<RayOutput>& outputs, double bound) {
    const reference::ShFunction f({lmax, false}, glyph);
    Comparison result;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const reference::GlyphHits expected = truth(f, rays[i]);
        if (!(expected.first_shift < 1e-3)) continue;
        ++result.rays;
        const bool hit = outputs[i].amplitude != 0;
        if (hit != !expected.hits.empty()) {
            ++result.wrong;
        } else if (hit) {
            const double error = std::abs(outputs[i].t - expected.hits[0].t);
            const bool same_sign = (outputs[i].amplitude > 0) == (expected.hits[0].amplitude > 0);
            result.wrong += !(error < bound) || !same_sign;
            result.worst = std::max(result.worst, error);
        }
    }
    return result;
}

std::string moduleOf(int lmax) { return "test_polynomial_even" + std::to_string(lmax); }

struct Region {
    float nearest, farthest;  // distance of the rays from the centre
};

/// Three glyphs of 300 rays each.
Comparison compareRegion(const Solve& solve, int lmax, Region region, double bound, bool from_inside = false) {
    std::mt19937 random(12);
    Comparison sum;
    for (int i = 0; i < 3; ++i) {
        const std::vector<float> glyph = randomGlyph(random, lmax);
        std::vector<RayInput> rays = randomRays(random, 300, region.nearest, region.farthest);
        if (from_inside) {
            for (RayInput& ray : rays) ray.origin += 2.9F * ray.direction;
        }
        const Comparison part = compare(glyph, lmax, rays, solve(glyph, rays), bound);
        sum = {sum.rays + part.rays, sum.wrong + part.wrong, std::max(sum.worst, part.worst)};
    }
    std::printf("k %2d  distance %g to %g: %d rays, %d wrong, worst error %.2g\n", lmax, double(region.nearest),
                double(region.farthest), sum.rays, sum.wrong, sum.worst);
    return sum;
}

class PolynomialFunctions : public test::FunctionTest {
protected:
    Solve solver(int lmax, std::uint32_t stop) {
        return [this, lmax, stop](const std::vector<float>& glyph, const std::vector<RayInput>& rays) {
            return runFunction<RayOutput>(moduleOf(lmax), {stop, kFirstHit}, rays, glyph);
        };
    }
};

TEST_F(PolynomialFunctions, StopOnBracketIsExactOverTheWholeGlyph) {
    for (const int lmax : {2, 4, 6, 8, 10, 12}) {
        const Comparison result = compareRegion(solver(lmax, kBracketStop), lmax, {0.02F, 1}, 2e-5);
        EXPECT_EQ(result.wrong, 0) << lmax;
        EXPECT_GT(result.rays, 890);
    }
}

TEST_F(PolynomialFunctions, StopOnBracketIsNearlyAlwaysRightAtTheCentre) {
    // Float32 coefficients, not the stop, are the limit here; it grows with the conditioning of the Vandermonde matrix.
    for (const int lmax : {4, 8, 12}) {
        const int allowed = lmax <= 8 ? 5 : 20;
        for (const Region region : {Region{0, 0.02F}, Region{0, 2e-4F}}) {
            EXPECT_LE(compareRegion(solver(lmax, kBracketStop), lmax, region, 1e-3).wrong, allowed) << lmax;
        }
    }
}

TEST_F(PolynomialFunctions, StopOfThePaperIsRightOverTheWholeGlyphAndFailsAtTheCentre) {
    for (const int lmax : {4, 8, 12}) {
        EXPECT_LE(compareRegion(solver(lmax, kPaperStop), lmax, {0.02F, 1}, 2e-3).wrong, lmax <= 8 ? 5 : 20) << lmax;
        EXPECT_GT(compareRegion(solver(lmax, kPaperStop), lmax, {0, 2e-4F}, 1e-3).wrong, 20) << lmax;
    }
}

TEST_F(PolynomialFunctions, StartsAtTheFirstParameterAllowed) {
    for (const int lmax : {4, 8}) {
        const Comparison result = compareRegion(solver(lmax, kBracketStop), lmax, {0.02F, 0.5F}, 2e-5, true);
        EXPECT_LE(result.wrong, 1) << lmax;  // a ray that begins within rounding of the surface
    }
}

TEST_F(PolynomialFunctions, FindsEveryHitOfALine) {
    std::mt19937 random(14);
    for (const int lmax : {4, 8, 12}) {
        const std::vector<float> glyph = randomGlyph(random, lmax);
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
