// Peaks of glyphs against dense sampling, and known ones exactly.
#include "build/peaks.h"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "reference/peaks.h"

namespace radiata {
namespace {

std::vector<float> randomCoefficients(ShLayout layout, std::uint32_t seed, double decay) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    std::vector<float> coefficients(layout.count());
    for (int l = 0; l <= layout.lmax; l += layout.step()) {
        for (int m = -l; m <= l; ++m) {
            coefficients[layout.index(l, m)] = static_cast<float>(normal(random) * std::exp(-decay * l));
        }
    }
    coefficients[0] += 1;
    return coefficients;
}

double angleDeg(const glm::dvec3& a, const glm::dvec3& b) {
    return glm::degrees(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)));
}

/// Every peak of either is one of the other, but for those that are flat, or that the sampling takes for one.
TEST(Peaks, AreThoseOfDenseSampling) {
    double worst_deg = 0, worst_amplitude = 0, slowest_ms = 0;
    std::size_t count = 0;
    for (const ShLayout layout : {ShLayout{2, false}, {4, false}, {8, false}, {16, false}, {3, true}, {8, true}}) {
        for (std::uint32_t seed = 0; seed < 3; ++seed) {
            const std::vector<float> coefficients = randomCoefficients(layout, seed + 1, seed == 2 ? 0.0 : 0.2);
            const auto begin = std::chrono::steady_clock::now();
            const std::vector<model::Peak> found = PeakFinder(layout, coefficients).peaks();
            slowest_ms = std::max(slowest_ms,
                                  std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count());
            const std::vector<model::Peak> expected = reference::peaks(reference::ShFunction(layout, coefficients));
            EXPECT_EQ(found.size() * (layout.full ? 1 : 2), expected.size())
                << layout.lmax << " " << layout.full << " " << seed;
            for (std::size_t i = 1; i < found.size(); ++i) EXPECT_GE(found[i - 1].amplitude, found[i].amplitude);
            for (const model::Peak& peak : expected) {
                double nearest = 180, amplitude = 0;
                for (const model::Peak& other : found) {
                    const double here = layout.full ? angleDeg(peak.direction, other.direction)
                                                    : std::min(angleDeg(peak.direction, other.direction),
                                                               angleDeg(-peak.direction, other.direction));
                    if (here >= nearest) continue;
                    nearest = here;
                    amplitude = other.amplitude;
                }
                worst_deg = std::max(worst_deg, nearest);
                worst_amplitude = std::max(worst_amplitude, std::abs(amplitude - peak.amplitude));
                ++count;
            }
        }
    }
    EXPECT_LT(worst_deg, 0.01);
    EXPECT_LT(worst_amplitude, 1e-9);
    EXPECT_GT(count, 200U);
    std::printf("%zu peaks, worst angle %.2g degrees, slowest glyph %.1f ms\n", count, worst_deg, slowest_ms);
}

/// x^2 + 2 y^2 + 3 z^2 - 1.5 has its only peak along z, y is a saddle.
TEST(Peaks, OfAnEllipsoidIsItsLongAxisAndRidgesAreNone) {
    const ShLayout layout{2, false};
    const double norm_20 = std::sqrt(5 / (16 * std::numbers::pi)), norm_22 = std::sqrt(15 / (16 * std::numbers::pi));
    std::vector<float> c(6);
    c[0] = 1;
    c[layout.index(2, 0)] = static_cast<float>(0.5 / norm_20);    // 3 z^2 - 1
    c[layout.index(2, -2)] = static_cast<float>(-0.2 / norm_22);  // x^2 - y^2
    const std::vector<model::Peak> peaks = PeakFinder(layout, c).peaks();
    ASSERT_EQ(peaks.size(), 1U);
    EXPECT_LT(std::min(angleDeg(peaks[0].direction, {0, 0, 1}), angleDeg(peaks[0].direction, {0, 0, -1})), 1e-6);
    EXPECT_NEAR(peaks[0].amplitude, 0.5 / std::sqrt(std::numbers::pi) + 1, 1e-6);
    // A disc has a ridge, a sphere is flat, and what is negative everywhere has nothing above 0.
    std::vector<float> disc = c;
    disc[layout.index(2, -2)] = 0;
    disc[layout.index(2, 0)] *= -1;
    EXPECT_TRUE(PeakFinder(layout, disc).peaks().empty());
    EXPECT_TRUE(PeakFinder(layout, std::vector<float>{1, 0, 0, 0, 0, 0}).peaks().empty());
    c[0] = -20;
    EXPECT_TRUE(PeakFinder(layout, c).peaks().empty());
}

TEST(Peaks, RankIsThatOfTheLobeWhichIsClimbed) {
    for (const ShLayout layout : {ShLayout{8, false}, ShLayout{8, true}}) {
        model::PickedGlyph glyph;
        glyph.layout = layout;
        glyph.coefficients = randomCoefficients(layout, 7, 0.15);
        const std::vector<model::Peak> peaks = PeakFinder(layout, glyph.coefficients).peaks();
        ASSERT_GE(peaks.size(), 3U);
        for (std::size_t i = 0; i < peaks.size(); ++i) {
            for (const double end : {1.0, layout.full ? 1.0 : -1.0}) {
                const glm::dvec3 aside = glm::normalize(glm::cross(peaks[i].direction, glm::dvec3(0.3, 0.5, 0.8)));
                glyph.direction = glm::normalize(end * peaks[i].direction + std::tan(glm::radians(1.0)) * aside);
                findPeaks(glyph);
                EXPECT_EQ(glyph.peak_rank, static_cast<int>(i) + 1);
                EXPECT_NEAR(glyph.peak_angle_deg, 1, 1e-6);
                EXPECT_EQ(glyph.peaks.size(), peaks.size());
                if (layout.full) continue;
                for (const model::Peak& peak : glyph.peaks) EXPECT_GE(glm::dot(peak.direction, glyph.direction), 0);
            }
        }
        // In the deepest hollow there is no lobe.
        std::vector<float> negated = glyph.coefficients;
        for (float& value : negated) value = -value;
        const std::vector<model::Peak> hollows = PeakFinder(layout, negated).peaks();
        ASSERT_FALSE(hollows.empty());
        glyph.direction = hollows.front().direction;
        findPeaks(glyph);
        EXPECT_EQ(glyph.peak_rank, 0);
        EXPECT_EQ(glyph.peak_angle_deg, 0);
    }
}

}  // namespace
}  // namespace radiata
