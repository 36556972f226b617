// Glyphs of uncertainty: what the recipe and standard deviations make of an image, and what is refused.
#include "build/uncertain_glyphs.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numeric>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "base/error.h"
#include "build/phantom.h"
#include "math/sh_evaluate.h"
#include "unit/build/sphere_function.h"

namespace radiata {
namespace {

model::ShImage randomImage(ShLayout layout, const glm::ivec3& size, std::uint32_t seed, bool positive = false) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> unit(-1, 1);
    model::ShImage image;
    image.size = size;
    image.layout = layout;
    image.file_convention = ShConvention::kDescoteaux07;
    image.source = positive ? "deviations" : "mean";
    for (int z = 0; z < size.z; ++z) {
        for (int y = 0; y < size.y; ++y) {
            for (int x = 0; x < size.x; ++x) image.voxels.emplace_back(x, y, z);
        }
    }
    image.coefficients.resize(image.voxels.size() * layout.count());
    for (float& c : image.coefficients) c = positive ? std::abs(unit(random)) : unit(random);
    return image;
}

std::vector<std::uint32_t> allSlots(const model::ShImage& image) {
    std::vector<std::uint32_t> slots(image.voxels.size());
    std::iota(slots.begin(), slots.end(), 0U);
    return slots;
}

std::string refusal(const std::function<void()>& body) {
    try {
        body();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), Code::kInvalidArgument);
        return error.what();
    }
    ADD_FAILURE() << "nothing was refused";
    return {};
}

TEST(UncertaintyRecipe, MultipliesTheConstantPartAndSpreadsEachCoefficient) {
    const model::ShImage mean = randomImage({4, false}, {20, 20, 10}, 1);
    UncertaintyRecipe recipe;
    recipe.seed = 7;
    const model::ShImage image = uncertaintyByRecipe(mean, recipe);
    EXPECT_EQ(image.voxels, mean.voxels);
    double sum[2] = {0, 0}, squares[2] = {0, 0};
    std::size_t counted[2] = {0, 0};
    for (std::size_t i = 0; i < image.coefficients.size(); ++i) {
        if (std::abs(mean.coefficients[i]) < 1e-3) continue;
        const int constant = i % mean.layout.count() == 0;
        const double ratio = static_cast<double>(image.coefficients[i]) / static_cast<double>(mean.coefficients[i]);
        sum[constant] += ratio;
        squares[constant] += ratio * ratio;
        ++counted[constant];
    }
    // Bounds: four standard errors of 4,000 and 56,000 variates.
    for (const int constant : {0, 1}) {
        const double expected = constant ? 1.7 : 1.0, n = static_cast<double>(counted[constant]);
        const double average = sum[constant] / n;
        EXPECT_NEAR(average, expected, 4 * 0.05 * expected / std::sqrt(n));
        EXPECT_NEAR(std::sqrt(squares[constant] / n - average * average), 0.05 * expected,
                    4 * 0.05 * expected / std::sqrt(2 * n));
    }
}

TEST(UncertaintyRecipe, DependsOnSeedAndPlaceOnly) {
    const model::ShImage mean = randomImage({2, false}, {5, 4, 3}, 2);
    UncertaintyRecipe recipe;
    const model::ShImage first = uncertaintyByRecipe(mean, recipe);
    EXPECT_EQ(first.coefficients, uncertaintyByRecipe(mean, recipe).coefficients);
    // The same voxels when others are missing.
    model::ShImage fewer = mean;
    fewer.voxels.erase(fewer.voxels.begin(), fewer.voxels.begin() + 20);
    fewer.coefficients.erase(fewer.coefficients.begin(), fewer.coefficients.begin() + 20 * 6);
    const model::ShImage part = uncertaintyByRecipe(fewer, recipe);
    EXPECT_TRUE(std::equal(part.coefficients.begin(), part.coefficients.end(), first.coefficients.begin() + 20 * 6));
    recipe.seed = 2;
    EXPECT_NE(first.coefficients, uncertaintyByRecipe(mean, recipe).coefficients);
    recipe.deviation = 0;
    recipe.constant = 1;
    EXPECT_EQ(mean.coefficients, uncertaintyByRecipe(mean, recipe).coefficients);
}

TEST(UncertaintyRecipe, RefusesWhatIsNoFactor) {
    const model::ShImage mean = randomImage({0, false}, {1, 1, 1}, 3);
    for (const double bad : {-0.1, 101.0, std::numeric_limits<double>::quiet_NaN()}) {
        EXPECT_NE(refusal([&] { uncertaintyByRecipe(mean, {bad, 0.05, 1}); }).find("constant"), std::string::npos);
        EXPECT_NE(refusal([&] { uncertaintyByRecipe(mean, {1.7, bad, 1}); }).find("deviation"), std::string::npos);
    }
}

/// Largest |outer - (f + factor s)| / (factor max s) over all voxels and 500 directions.
double worstFit(ShLayout layout, double smallest, double largest) {
    const double factor = 2;
    const model::ShImage mean = randomImage(layout, {3, 2, 2}, 5);
    model::ShImage deviations = randomImage(layout, {3, 2, 2}, 6, true);
    for (float& s : deviations.coefficients) s = static_cast<float>(smallest + (largest - smallest) * static_cast<double>(s));
    const model::ShImage outer = outerGlyphs(mean, allSlots(mean), deviations, factor, layout.lmax);
    EXPECT_EQ(outer.voxels, mean.voxels);
    double worst = 0;
    std::vector<double> basis(layout.count());
    for (std::size_t v = 0; v < mean.voxels.size(); ++v) {
        double largest_s = 0, worst_here = 0;
        for (const glm::dvec3& d : testing::fibonacciDirections(500)) {
            evaluateSh(layout, d, basis);
            double f = 0, variance = 0, made = 0;
            for (std::size_t c = 0; c < layout.count(); ++c) {
                const std::size_t at = v * layout.count() + c;
                f += basis[c] * static_cast<double>(mean.coefficients[at]);
                variance += std::pow(basis[c] * static_cast<double>(deviations.coefficients[at]), 2);
                made += basis[c] * static_cast<double>(outer.coefficients[at]);
            }
            largest_s = std::max(largest_s, std::sqrt(variance));
            worst_here = std::max(worst_here, std::abs(made - f - factor * std::sqrt(variance)) / factor);
        }
        worst = std::max(worst, worst_here / largest_s);
    }
    std::printf("%s bands to %2d, deviations %g to %g: off by at most %.2g of the largest\n", layout.full ? "all " : "even",
                layout.lmax, smallest, largest, worst);
    return worst;
}

TEST(OuterGlyphs, LieADeviationOutsideOfTheMean) {
    for (const ShLayout layout : {ShLayout{2, false}, ShLayout{8, false}, ShLayout{12, false}, ShLayout{4, true}}) {
        // Equal deviations give the same s in all directions (Unsoeld), which any band holds exactly.
        EXPECT_LE(worstFit(layout, 1, 1), 1e-6);
        EXPECT_LE(worstFit(layout, 0.8, 1.2), layout.lmax >= 8 ? 0.07 : 0.16);
        EXPECT_LE(worstFit(layout, 0, 1), layout.lmax >= 8 ? 0.26 : 0.65);
    }
}

TEST(OuterGlyphs, OfOneUncertainConstantAreExact) {
    // Only the constant part is uncertain: s is the same in all directions, and the fit is exact.
    const ShLayout layout{6, false};
    const model::ShImage mean = randomImage(layout, {2, 2, 1}, 8);
    model::ShImage deviations = randomImage(layout, {2, 2, 1}, 9, true);
    for (std::size_t i = 0; i < deviations.coefficients.size(); ++i) {
        if (i % layout.count() != 0) deviations.coefficients[i] = 0;
    }
    const model::ShImage outer = outerGlyphs(mean, allSlots(mean), deviations, 1.5, 6);
    for (std::size_t i = 0; i < outer.coefficients.size(); ++i) {
        EXPECT_NEAR(outer.coefficients[i], mean.coefficients[i] + 1.5F * deviations.coefficients[i], 1e-6F);
    }
}

TEST(OuterGlyphs, TakeSelectedVoxelsBandsAndMissingDeviations) {
    const ShLayout layout{4, false};
    const model::ShImage mean = randomImage(layout, {3, 1, 1}, 10);
    model::ShImage deviations = randomImage(layout, {3, 1, 1}, 11, true);
    deviations.voxels.erase(deviations.voxels.begin() + 1);
    deviations.coefficients.erase(deviations.coefficients.begin() + 15, deviations.coefficients.begin() + 30);
    const std::vector<std::uint32_t> slots{1, 2};
    const model::ShImage outer = outerGlyphs(mean, slots, deviations, 1, 3);
    ASSERT_EQ(outer.layout, (ShLayout{2, false}));
    ASSERT_EQ(outer.voxels, (std::vector<glm::ivec3>{{1, 0, 0}, {2, 0, 0}}));
    for (std::size_t c = 0; c < 6; ++c) {
        EXPECT_EQ(outer.coefficients[c], mean.coefficients[15 + c]) << "no deviation: the mean itself";
    }
    EXPECT_GT(outer.coefficients[6], mean.coefficients[30]) << "the mean of s over all directions is positive";
}

TEST(OuterGlyphs, RefuseImagesThatDoNotFit) {
    const ShLayout layout{4, false};
    const model::ShImage mean = randomImage(layout, {3, 2, 1}, 12), good = randomImage(layout, {3, 2, 1}, 13, true);
    const auto refused = [&](const model::ShImage& deviations) {
        const std::string sentence = refusal([&] { outerGlyphs(mean, allSlots(mean), deviations, 1, 4); });
        EXPECT_NE(sentence.find("deviations"), std::string::npos) << sentence;
        return sentence;
    };
    EXPECT_NE(refused(randomImage(layout, {3, 3, 1}, 14, true)).find("3 x 3 x 1"), std::string::npos);
    EXPECT_NE(refused(randomImage({2, false}, {3, 2, 1}, 14, true)).find("even bands to 2"), std::string::npos);
    model::ShImage moved = good;
    moved.voxel_to_world[3].x += 0.5;
    EXPECT_NE(refused(moved).find("0.5"), std::string::npos);
    moved.voxel_to_world[3].x = std::numeric_limits<double>::quiet_NaN();
    EXPECT_NE(refused(moved).find("grid"), std::string::npos);
    model::ShImage turned = good;
    turned.file_axes = ShAxes::kVoxel;
    EXPECT_NE(refused(turned).find("world axes"), std::string::npos);
    model::ShImage lost = good;
    lost.rejected_voxels = 2;
    EXPECT_NE(refused(lost).find("2 voxels"), std::string::npos);
    model::ShImage negative = good;
    negative.coefficients[15 * 4 + 3] = -0.25F;
    EXPECT_NE(refused(negative).find("(1, 1, 0), volume 3"), std::string::npos);
    // A deviation is positive in the file; the reader's change of convention turns signs, which is no fault of the file.
    model::ShImage legacy = good;
    legacy.file_convention = ShConvention::kDescoteaux07Legacy;
    for (std::size_t v = 0; v < legacy.voxels.size(); ++v) {
        convertSh(std::span(legacy.coefficients).subspan(v * 15, 15), layout, ShConvention::kDescoteaux07Legacy,
                  ShConvention::kDescoteaux07);
    }
    EXPECT_NE(legacy.coefficients, good.coefficients);
    EXPECT_EQ(outerGlyphs(mean, allSlots(mean), legacy, 1, 4).coefficients,
              outerGlyphs(mean, allSlots(mean), good, 1, 4).coefficients);
}

TEST(MatchVoxels, FindsTheSameVoxelOrNone) {
    const model::ShImage image = randomImage({0, false}, {4, 3, 2}, 15);
    model::ShImage other = image;
    other.voxels = {{1, 0, 0}, {3, 0, 0}, {0, 2, 1}};
    const std::vector<std::uint32_t> slots{0, 1, 3, 20, 23};
    EXPECT_EQ(matchVoxels(image, slots, other), (std::vector<std::uint32_t>{0xffffffffU, 0, 1, 2, 0xffffffffU}));
}

}  // namespace
}  // namespace radiata
