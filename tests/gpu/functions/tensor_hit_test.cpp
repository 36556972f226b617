// Hits of the fixed steps and of the ranges against the exhaustive search of the reference.
#include <algorithm>
#include <cmath>

#include "gpu/functions/tensor_runner.h"
#include "reference/glyph_hits.h"

namespace radiata::test {
namespace {

class TensorHits : public TensorTest {
protected:
    struct Tally {
        int rays = 0, missed = 0, invented = 0, other = 0;  ///< other: not the first crossing, or of the wrong sign
        std::vector<double> errors;                         ///< of the right ones, radii
        double beyond = 0;                                  ///< largest distance of any hit from its nearest crossing, radii
        double median() {
            std::ranges::sort(errors);
            return errors.empty() ? 0 : errors[errors.size() / 2];
        }
    };

    /// \param near  distance within which a hit counts as the first crossing, radii
    Tally tally(const TensorGlyph& glyph, const TensorRun& run, const std::vector<RayInput>& rays, double near) {
        const reference::ShFunction f(glyph.layout, glyph.coefficients);
        const std::vector<RayOutput> outputs = hits(glyph, run, rays);
        const auto radius = static_cast<double>(glyph.radius);
        Tally result;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const reference::GlyphHits truth = test::truth(f, rays[i]);
            EXPECT_EQ(outputs[i].count, 0U) << "gave up";
            const bool hit = outputs[i].amplitude != 0;
            if (hit) {
                double nearest = 1e9;
                for (const reference::GlyphHit& h : truth.hits) nearest = std::min(nearest, std::abs(h.t - outputs[i].t));
                if (!truth.hits.empty()) result.beyond = std::max(result.beyond, nearest / radius);
            }
            if (!(truth.first_shift < 1e-3)) continue;
            ++result.rays;
            result.missed += !hit && !truth.hits.empty();
            result.invented += hit && truth.hits.empty();
            if (!hit || truth.hits.empty()) continue;
            const double error = std::abs(truth.hits[0].t - outputs[i].t) / radius;
            const bool right = error <= near && (truth.hits[0].amplitude > 0) == (outputs[i].amplitude > 0);
            result.other += !right;
            if (right) result.errors.push_back(error);
        }
        return result;
    }
};

TEST_F(TensorHits, OfFixedStepsLieWithinTheLastBracket) {
    std::mt19937 random(31);
    for (const int order : {2, 3, 4, 8}) {
        const TensorGlyph glyph = randomTensorGlyph(random, order);
        const std::vector<RayInput> rays = randomRays(random, 400, 0.02F, 1);
        for (const float step : {0.01F, 0.02F, 0.05F}) {
            for (std::uint32_t bisections = 0; bisections <= 3; ++bisections) {
                const TensorRun run{TensorMethod::kMarch, step, bisections, false, false, 12};
                const double bound = 1.01 * static_cast<double>(step) / std::pow(2.0, bisections + 1.0) + 1e-5;
                Tally result = tally(glyph, run, rays, bound);
                EXPECT_LT(result.beyond, bound) << order << " " << step << " " << bisections;
                EXPECT_EQ(result.invented, 0);
                EXPECT_LE(result.missed + result.other, result.rays / 20);
            }
        }
    }
}

TEST_F(TensorHits, InterpolationIsBetterThanTwoBisectionsForShortSteps) {
    // The paper says so of any step; at order 8 a step of 0.05 is too long for a straight line.
    std::mt19937 random(32);
    for (const int order : {4, 8}) {
        const TensorGlyph glyph = randomTensorGlyph(random, order);
        const std::vector<RayInput> rays = randomRays(random, 600, 0.02F, 0.8F);
        for (const float step : {0.01F, 0.02F, 0.05F}) {
            const double near = static_cast<double>(step);
            Tally two = tally(glyph, {TensorMethod::kMarch, step, 2, false, false, 12}, rays, near);
            Tally three = tally(glyph, {TensorMethod::kMarch, step, 3, false, false, 12}, rays, near);
            Tally linear = tally(glyph, {TensorMethod::kMarch, step, 0, true, false, 12}, rays, near);
            std::printf("order %d step %.2f: median error %.1e by two bisections, %.1e by three, %.1e by interpolation\n",
                        order, near, two.median(), three.median(), linear.median());
            EXPECT_TRUE(near > 0.03 || linear.median() < two.median()) << order << " " << step;
        }
    }
}

TEST_F(TensorHits, ShorterStepsNearTheCentreCloseGaps) {
    std::mt19937 random(33);
    Tally coarse, adaptive;
    for (int i = 0; i < 3; ++i) {
        const TensorGlyph glyph = randomTensorGlyph(random, 8);
        const std::vector<RayInput> rays = randomRays(random, 500, 0.001F, 0.15F);
        const auto add = [](Tally& sum, const Tally& part) {
            sum.rays += part.rays;
            sum.missed += part.missed + part.other;
        };
        add(coarse, tally(glyph, {TensorMethod::kMarch, 0.05F, 0, true, false, 12}, rays, 0.05));
        add(adaptive, tally(glyph, {TensorMethod::kMarch, 0.05F, 0, true, true, 12}, rays, 0.05));
    }
    std::printf("near the centre, step 0.05: %d of %d rays wrong, %d with steps of a third there\n", coarse.missed, coarse.rays,
                adaptive.missed);
    EXPECT_GT(coarse.missed, 0);
    EXPECT_LT(adaptive.missed, coarse.missed);
}

TEST_F(TensorHits, OfRangesAreRightDownToTheLastPiece) {
    std::mt19937 random(34);
    for (const int order : {2, 3, 4, 8}) {
        const TensorGlyph glyph = randomTensorGlyph(random, order);
        const std::vector<RayInput> rays = randomRays(random, 400, 0.05F, 1);
        double steps[2] = {0, 0};
        for (const TensorMethod method : {TensorMethod::kInterval, TensorMethod::kAffine}) {
            const TensorRun run{method, 0, 0, true, false, 12};
            Tally result = tally(glyph, run, rays, 1e-4);
            for (const RayOutput& output : hits(glyph, run, rays)) steps[method == TensorMethod::kAffine] += output.steps;
            EXPECT_EQ(result.invented, 0) << order;
            EXPECT_LE(result.missed + result.other, 1) << order;  // two crossings within one piece of 2^-12
            EXPECT_LT(result.beyond, 5e-4) << order;
        }
        std::printf("order %d: %.0f interval and %.0f affine evaluations a ray\n", order, steps[0] / 400, steps[1] / 400);
        EXPECT_LT(steps[1], steps[0]) << order;
    }
}

TEST_F(TensorHits, BeginAtTheFirstParameterAllowedAndWorkFromInside) {
    std::mt19937 random(35);
    const TensorGlyph glyph = randomTensorGlyph(random, 4);
    std::vector<RayInput> rays = randomRays(random, 400, 0.05F, 0.6F);
    for (RayInput& ray : rays) ray.origin += 2.9F * ray.direction;
    for (const TensorMethod method : {TensorMethod::kMarch, TensorMethod::kInterval, TensorMethod::kAffine}) {
        const Tally result = tally(glyph, {method, 0.01F, 3, true, false, 12}, rays, 1e-3);
        EXPECT_GT(result.rays, 300);
        EXPECT_LE(result.missed + result.invented + result.other, result.rays / 50) << static_cast<int>(method);
    }
}

TEST_F(TensorHits, SurviveDegenerateInput) {
    TensorGlyph sphere{2, {1, 0, 0, 1, 0, 1}, {2, false}, {}, 1.02F}, nothing{2, {0, 0, 0, 0, 0, 0}, {2, false}, {}, 1};
    const std::vector<RayInput> rays{{{0, 0, 3}, 0, {0, 0, -1}, 1},
                                     {{1.5F, 0, 3}, 0, {0, 0, -1}, 1},
                                     {{0, 0, 0}, 0, {1, 0, 0}, 1},
                                     {{0, 0, 3}, 9, {0, 0, -1}, 1}};
    for (const TensorMethod method : {TensorMethod::kMarch, TensorMethod::kInterval, TensorMethod::kAffine}) {
        const TensorRun run{method, 0.01F, 3, true, true, 12};
        const auto found = hits(sphere, run, rays);
        EXPECT_NEAR(found[0].t, 2, 1e-4);
        EXPECT_EQ(found[1].amplitude, 0);
        EXPECT_TRUE(found[2].t >= 0 && found[2].t < 1.0001F);  // from the centre itself, where both sides are 0
        EXPECT_EQ(found[3].amplitude, 0);
        for (const RayOutput& output : hits(nothing, run, rays)) EXPECT_EQ(output.amplitude, 0);
    }
}

}  // namespace
}  // namespace radiata::test
