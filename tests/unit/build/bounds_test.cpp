// Bounds against the true extents, found in double from 4,000 samples and a pattern search. Bounds: never smaller (beyond the
// search's own 1e-9), at most 2.2 % of the largest |f| or |d_a f| larger.
#include "build/bounds.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "base/error.h"
#include "build/phantom.h"
#include "math/sh_convention.h"
#include "support/npz.h"
#include "unit/build/sphere_function.h"

namespace radiata {
namespace {

using testing::Maximiser;
using testing::TrueExtents;

constexpr double kLargerAtMost = 0.022;
constexpr std::size_t kSamples = 4000;

std::vector<ShLayout> allLayouts() {
    std::vector<ShLayout> layouts;
    for (int lmax = 0; lmax <= 16; lmax += 2) layouts.push_back({lmax, false});
    for (int lmax = 1; lmax <= 8; ++lmax) layouts.push_back({lmax, true});
    return layouts;
}

/// Random coefficients, alike in all bands.
std::vector<float> randomGlyph(ShLayout layout, std::mt19937& random) {
    std::normal_distribution<float> normal;
    std::vector<float> c(layout.count());
    for (float& value : c) value = normal(random);
    return c;
}

/// One to three lobes about random directions, as fODFs have (with ringing, so with small negative lobes).
std::vector<float> lobedGlyph(ShLayout layout, std::mt19937& random) {
    std::normal_distribution<double> normal;
    std::vector<float> c(layout.count(), 0.0F);
    const int lobes = 1 + static_cast<int>(random() % 3);
    for (int i = 0; i < lobes; ++i) {
        const glm::dvec3 d = glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
        const std::vector<double> y = testing::basisAt(layout, d);
        for (std::size_t j = 0; j < c.size(); ++j) c[j] += static_cast<float>(y[j] / lobes);
    }
    return c;
}

void expectBounds(const GlyphBounds& bounds, const TrueExtents& truth, const char* what) {
    const double rounding = 1e-9 * truth.amplitude_max;
    EXPECT_GE(bounds.radius, truth.radius - rounding) << what;
    EXPECT_LE(bounds.radius, truth.radius + kLargerAtMost * truth.amplitude_max) << what;
    EXPECT_LE(bounds.amplitude_max, truth.amplitude_max * (1 + 1e-5)) << what;
    EXPECT_GE(bounds.amplitude_max, truth.amplitude_max * 0.97) << what;
    for (int axis = 0; axis < 3; ++axis) {
        const double slack = kLargerAtMost * truth.signed_extent[axis] + 1e-4 * truth.amplitude_max;
        EXPECT_GE(bounds.max[axis], truth.along[axis] - rounding) << what << ", axis " << axis;
        EXPECT_LE(bounds.max[axis], truth.along[axis] + slack) << what << ", axis " << axis;
        EXPECT_GE(-bounds.min[axis], truth.along[axis + 3] - rounding) << what << ", axis -" << axis;
        EXPECT_LE(-bounds.min[axis], truth.along[axis + 3] + slack) << what << ", axis -" << axis;
    }
}

TEST(Bounds, HoldTheGlyphAndAreTightForEveryLayout) {
    std::mt19937 random(7);
    for (const ShLayout layout : allLayouts()) {
        SCOPED_TRACE((layout.full ? "full, lmax " : "even, lmax ") + std::to_string(layout.lmax));
        const BoundsEvaluator evaluator(layout);
        const Maximiser maximiser(layout, kSamples);
        std::vector<float> coefficients;
        constexpr int kGlyphs = 9;
        for (int g = 0; g < kGlyphs; ++g) {
            std::vector<float> c = g % 2 == 0 ? randomGlyph(layout, random) : lobedGlyph(layout, random);
            if (g >= 6) c[0] += 4.0F * static_cast<float>(g - 7);  // mostly negative, balanced, mostly positive
            coefficients.insert(coefficients.end(), c.begin(), c.end());
        }
        for (bool negative_lobes : {false, true}) {
            std::vector<GlyphBounds> bounds(kGlyphs);
            evaluator.evaluate(coefficients, negative_lobes, bounds);
            for (int g = 0; g < kGlyphs; ++g) {
                const auto c = std::span(coefficients).subspan(g * layout.count(), layout.count());
                expectBounds(bounds[g], maximiser.extents(c, negative_lobes), negative_lobes ? "shown" : "hidden");
            }
        }
    }
}

/// Glyphs of a measured brain with extents found by brute force elsewhere; without the folder, glyphs of the test brain whose
/// extents are found here.
TEST(Bounds, HoldGlyphsOfABrain) {
    const char* folder = std::getenv("RADIATA_DATA");
    for (const int lmax : {4, 8, 12}) {
        const ShLayout layout{lmax, false};
        const BoundsEvaluator evaluator(layout);
        const std::size_t count = layout.count();
        if (folder == nullptr) {
            PhantomOptions options;
            options.slice_glyphs = 100;
            options.lmax = lmax;
            const model::ShImage image = phantomShImage(options);
            const Maximiser maximiser(layout, kSamples);
            for (std::size_t v = 0; v < image.voxels.size(); v += 4) {
                const auto c = std::span(image.coefficients).subspan(v * count, count);
                GlyphBounds bounds;
                evaluator.evaluate(c, false, {&bounds, 1});
                expectBounds(bounds, maximiser.extents(c, false), "phantom");
            }
            continue;
        }
        const testing::NpzFile file(std::filesystem::path(folder) / "refs" /
                                    ("xa140_fod" + std::to_string(lmax) + "_geometry.npz"));
        const std::vector<double> written = file.array("coef_mrtrix").values;
        const std::vector<double> radii = file.array("radius_max").values;
        std::vector<float> coefficients(written.begin(), written.end());
        ASSERT_EQ(coefficients.size(), radii.size() * count);
        for (std::size_t g = 0; g < radii.size(); ++g) {
            convertSh(std::span(coefficients).subspan(g * count, count), layout, ShConvention::kTournier07,
                      ShConvention::kDescoteaux07);
        }
        for (const bool negative_lobes : {false, true}) {
            const std::vector<double> boxes = file.array(negative_lobes ? "aabb_abs" : "aabb_pos").values;
            std::vector<GlyphBounds> bounds(radii.size());
            evaluator.evaluate(coefficients, negative_lobes, bounds);
            for (std::size_t g = 0; g < radii.size(); ++g) {
                const double rounding = 2e-8 * radii[g];  // the references are exact to about that
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    const int a = static_cast<int>(axis);
                    EXPECT_LE(bounds[g].min[a], boxes[g * 6 + axis] + rounding);
                    EXPECT_GE(bounds[g].max[a], boxes[g * 6 + 3 + axis] - rounding);
                    EXPECT_LE(bounds[g].max[a], boxes[g * 6 + 3 + axis] * (1 + kLargerAtMost) + 1e-3 * radii[g]);
                }
                if (negative_lobes) {
                    EXPECT_GE(bounds[g].radius, radii[g] - rounding);
                    EXPECT_LE(bounds[g].radius, radii[g] * (1 + kLargerAtMost));
                }
            }
        }
    }
}

TEST(Bounds, SingleCoefficientsOfBothSigns) {
    for (const ShLayout layout : {ShLayout{8, false}, ShLayout{3, true}}) {
        const BoundsEvaluator evaluator(layout);
        const Maximiser maximiser(layout, kSamples);
        for (std::size_t j = 0; j < layout.count(); j += 3) {
            for (float value : {1.0F, -1.0F}) {
                std::vector<float> c(layout.count(), 0.0F);
                c[j] = value;
                GlyphBounds bounds;
                evaluator.evaluate(c, false, {&bounds, 1});
                expectBounds(bounds, maximiser.extents(c, false), "single");
            }
        }
    }
}

TEST(Bounds, CoveringRadiusHoldsForRandomDirections) {
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    for (const ShLayout layout : {ShLayout{0, false}, ShLayout{8, false}, ShLayout{5, true}}) {
        const BoundsEvaluator evaluator(layout);
        double farthest = 0;
        for (int i = 0; i < 20000; ++i) {
            const glm::dvec3 d = glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
            double cosine = -1;
            for (const glm::dvec3& sample : evaluator.directions()) {
                const double c = glm::dot(d, sample);
                cosine = std::max(cosine, layout.full ? c : std::abs(c));
            }
            farthest = std::max(farthest, std::acos(std::min(1.0, cosine)));
        }
        EXPECT_LE(farthest, evaluator.coveringRadius());
        EXPECT_GE(farthest, 0.9 * evaluator.coveringRadius());  // else the proven radius wastes samples
        EXPECT_LE(1 / std::cos((layout.lmax + 1) * evaluator.coveringRadius()), 1.02);
    }
}

TEST(Bounds, ZeroGlyphHasAnEmptyBox) {
    const BoundsEvaluator evaluator({8, false});
    const std::vector<float> c(45, 0.0F);
    GlyphBounds bounds;
    evaluator.evaluate(c, true, {&bounds, 1});
    EXPECT_EQ(bounds.min, glm::vec3(0));
    EXPECT_EQ(bounds.max, glm::vec3(0));
    EXPECT_EQ(bounds.radius, 0);
    EXPECT_EQ(bounds.amplitude_max, 0);
}

TEST(Bounds, NegativeSphereIsEmptyWhenNegativeLobesAreHidden) {
    const BoundsEvaluator evaluator({4, false});
    std::vector<float> c(15, 0.0F);
    c[0] = -3;
    c[3] = 0.1F;
    GlyphBounds bounds;
    evaluator.evaluate(c, false, {&bounds, 1});
    EXPECT_EQ(bounds.radius, 0);
    EXPECT_EQ(bounds.max, glm::vec3(0));
    EXPECT_GT(bounds.amplitude_max, 0.8F);
    evaluator.evaluate(c, true, {&bounds, 1});
    EXPECT_GT(bounds.radius, 0.8F);
}

TEST(Bounds, ScaleOverTheWholeRangeOfFloat) {
    std::mt19937 random(5);
    const ShLayout layout{6, false};
    const BoundsEvaluator evaluator(layout);
    const std::vector<float> c = randomGlyph(layout, random);
    GlyphBounds one;
    evaluator.evaluate(c, false, {&one, 1});
    for (int exponent : {-120, -60, 60, 120}) {
        std::vector<float> scaled = c;
        for (float& value : scaled) value = std::ldexp(value, exponent);
        GlyphBounds bounds;
        evaluator.evaluate(scaled, false, {&bounds, 1});
        EXPECT_FLOAT_EQ(bounds.radius, std::ldexp(one.radius, exponent));
        EXPECT_FLOAT_EQ(bounds.max.x, std::ldexp(one.max.x, exponent));
    }
    const std::vector<float> largest(layout.count(), std::numeric_limits<float>::max());
    const std::vector<float> smallest(layout.count(), std::numeric_limits<float>::denorm_min());
    GlyphBounds bounds;
    evaluator.evaluate(largest, true, {&bounds, 1});
    EXPECT_EQ(bounds.radius, std::numeric_limits<float>::max());
    EXPECT_TRUE(std::isfinite(bounds.min.y));
    evaluator.evaluate(smallest, true, {&bounds, 1});
    EXPECT_GT(bounds.radius, 0);
    EXPECT_LT(bounds.radius, 1e-42F);
}

TEST(Bounds, ManyGlyphsEqualOneByOne) {
    std::mt19937 random(11);
    const ShLayout layout{4, true};
    const BoundsEvaluator evaluator(layout);
    constexpr std::size_t kGlyphs = 131;  // odd, more than one block
    std::vector<float> coefficients;
    for (std::size_t g = 0; g < kGlyphs; ++g) {
        const std::vector<float> c = randomGlyph(layout, random);
        coefficients.insert(coefficients.end(), c.begin(), c.end());
    }
    std::vector<GlyphBounds> all(kGlyphs);
    evaluator.evaluate(coefficients, false, all);
    for (std::size_t g = 0; g < kGlyphs; ++g) {
        GlyphBounds bounds;
        evaluator.evaluate(std::span(coefficients).subspan(g * layout.count(), layout.count()), false, {&bounds, 1});
        EXPECT_EQ(bounds.min, all[g].min);
        EXPECT_EQ(bounds.max, all[g].max);
        EXPECT_EQ(bounds.radius, all[g].radius);
    }
}

TEST(Bounds, RefusesWhatIsNotFinite) {
    const BoundsEvaluator evaluator({2, false});
    GlyphBounds bounds;
    for (float bad : {std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()}) {
        const std::vector<float> c{1, 0, bad, 0, 0, 0};
        EXPECT_THROW(evaluator.evaluate(c, false, {&bounds, 1}), Error);
    }
    const std::vector<float> short_by_one(5, 1.0F);
    EXPECT_THROW(evaluator.evaluate(short_by_one, false, {&bounds, 1}), Error);
}

}  // namespace
}  // namespace radiata
