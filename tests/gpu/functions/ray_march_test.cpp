// Marches with steps of equal length against the reference. What they can see they must see: where the first two hits are
// farther apart than a piece of the ray, hit or miss and sign are right and t is within the error of the refinement: half a
// piece halved kBisections times, or for regula falsi 2e-5 radii (k = 4) or 5e-4 (above) after kFalsiSteps. What lies within
// one piece may be missed; how much is counted and bounded.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "gpu/functions/march_runner.h"

namespace radiata {
namespace {

using namespace test;

constexpr std::uint32_t kBisections = 10, kFalsiSteps = 4;

enum class Way { kPeeters, kPerRay, kTable };

class RayMarches : public FunctionTest {
protected:
    struct Tally {
        int rays = 0, unseen = 0, wrong = 0, wrong_unseen = 0;
        double worst = 0;
    };

    /// Rays of a camera at `eye`, or for the other two ways any rays.
    Tally compareGlyphs(Way way, ShLayout layout, std::uint32_t steps, Region region, double bound) {
        std::mt19937 random(51);
        const BoundsEvaluator evaluator(layout);
        Tally tally;
        for (int i = 0; i < 3; ++i) {
            const std::vector<float> glyph = randomGlyph(random, layout);
            const reference::ShFunction f(layout, glyph);
            std::vector<RayInput> rays = randomRays(random, 300, region.nearest, region.farthest);
            const glm::vec3 pole = glm::normalize(glm::vec3(0.3F, -0.8F, 0.5F));
            if (way == Way::kTable) {
                for (RayInput& ray : rays) {
                    const glm::vec3 closest = ray.origin - glm::dot(ray.origin, ray.direction) * ray.direction;
                    ray.origin = 3.0F * pole;
                    ray.direction = glm::normalize(closest - ray.origin);
                }
            }
            const float radius = certifiedRadius(evaluator, glyph);
            std::vector<float> shared = glyph;
            shared.insert(shared.end(), {radius, pole.x, pole.y, pole.z});
            const std::uint32_t refinements = way == Way::kPeeters ? kBisections : kFalsiSteps;
            const auto outputs =
                runFunction<RayOutput>("test_ray_march_" + nameOf(layout),
                                       {way != Way::kPeeters, steps, refinements, way == Way::kTable}, rays, shared);
            for (std::size_t ray = 0; ray < rays.size(); ++ray) {
                const reference::GlyphHits expected = truth(f, rays[ray]);
                if (!(expected.first_shift < 1e-3)) continue;
                ++tally.rays;
                // Pieces are at most so long.
                const double piece = 2 * double(radius) / steps;
                const auto& hits = expected.hits;
                const bool seen = hits.size() < 2 || hits[1].t - hits[0].t > piece;
                const bool hit = outputs[ray].amplitude != 0;
                bool wrong = hit == hits.empty() || (hit && (outputs[ray].amplitude > 0) != (hits[0].amplitude > 0));
                const double error = hit && !hits.empty() ? std::abs(double(outputs[ray].t) - hits[0].t) / double(radius) : 0;
                wrong = wrong || error > bound;
                tally.unseen += !seen;
                (seen ? tally.wrong : tally.wrong_unseen) += wrong;
                if (seen && !wrong) tally.worst = std::max(tally.worst, error);
                if (seen && wrong && tally.wrong <= 3) printRay(rays[ray], outputs[ray], expected);
            }
        }
        std::printf(
            "%s %2d, %u steps, distance %g to %g: %d rays, %d wrong, worst error %.2g; %d with hits within a piece, %d of them "
            "wrong\n",
            way == Way::kPeeters  ? "Peeters"
            : way == Way::kPerRay ? "van Almsick per ray"
                                  : "van Almsick for the camera",
            layout.lmax, steps, double(region.nearest), double(region.farthest), tally.rays, tally.wrong, tally.worst,
            tally.unseen, tally.wrong_unseen);
        return tally;
    }
};

TEST_F(RayMarches, OfPeetersSeeWhatIsLongerThanAPiece) {
    for (const int lmax : {4, 8, 12}) {
        for (const std::uint32_t steps : {100U, 200U}) {
            const Tally tally = compareGlyphs(Way::kPeeters, {lmax, false}, steps, {0.02F, 1}, 2.0 / steps / 1024 + 2e-6);
            EXPECT_EQ(tally.wrong, 0) << lmax;
            EXPECT_LT(tally.unseen, 90) << lmax;
        }
    }
}

TEST_F(RayMarches, OfVanAlmsickSeeWhatIsLongerThanAPiece) {
    for (const Way way : {Way::kPerRay, Way::kTable}) {
        for (const int lmax : {4, 8, 12}) {
            for (const std::uint32_t steps : {100U, 200U}) {
                const Tally tally = compareGlyphs(way, {lmax, false}, steps, {0.02F, 1}, lmax == 4 ? 2e-5 : 5e-4);
                EXPECT_EQ(tally.wrong, 0) << lmax;
                EXPECT_LT(tally.unseen, 90) << lmax;
            }
        }
    }
}

/// Why the paper left them: at the centre lobes are thinner than a piece.
TEST_F(RayMarches, MissLobesAtTheCentre) {
    for (const Way way : {Way::kPeeters, Way::kPerRay}) {
        const Tally coarse = compareGlyphs(way, {8, false}, 100, {0, 0.02F}, 2e-3),
                    fine = compareGlyphs(way, {8, false}, 1000, {0, 0.02F}, 2e-3);
        EXPECT_GT(coarse.wrong_unseen, 0);
        EXPECT_LE(fine.wrong + fine.wrong_unseen, coarse.wrong + coarse.wrong_unseen);
    }
}

TEST_F(RayMarches, SurviveDegenerateInput) {
    std::vector<float> nothing(15, 0.0F), sphere(15, 0.0F);
    sphere[0] = 3.5449077F;  // radius 1
    const std::vector<RayInput> rays{{{0, 0, 3}, 0, {0, 0, -1}, 1},
                                     {{0.5F, 0, 3}, 0, {0, 0, -1}, 0},
                                     {{1.5F, 0, 3}, 0, {0, 0, -1}, 1},
                                     {{0, 0, 0}, 0, {1, 0, 0}, 1}};
    for (const bool van_almsick : {false, true}) {
        const auto run = [&](std::vector<float> glyph, float radius) {
            glyph.insert(glyph.end(), {radius, 0, 0, 1});
            return runFunction<RayOutput>("test_ray_march_even4", {van_almsick, 100, 10, 0}, rays, glyph);
        };
        for (const RayOutput& output : run(nothing, 0)) EXPECT_EQ(output.amplitude, 0);
        for (const RayOutput& output : run(nothing, 1)) EXPECT_EQ(output.amplitude, 0);
        const auto hits = run(sphere, 1.01F);
        EXPECT_NEAR(hits[0].t, 2, 3e-5);
        EXPECT_NEAR(hits[1].t, 3 - std::sqrt(0.75), 3e-5);
        EXPECT_EQ(hits[2].amplitude, 0);
        // From the very centre: that, or the end of the lobe.
        EXPECT_TRUE(std::abs(hits[3].t) < 1e-6F || std::abs(hits[3].t - 1) < 3e-5F) << hits[3].t;
    }
}

}  // namespace
}  // namespace radiata
