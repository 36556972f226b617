// Scrambled Sobol pairs: the property that defines a (0, 2)-sequence, independence of seeds, and what they are for.
#include "math/low_discrepancy.h"

#include <cmath>
#include <random>
#include <set>
#include <vector>

#include <gtest/gtest.h>

namespace radiata {
namespace {

TEST(LowDiscrepancy, EveryBlockIsANetInBaseTwo) {
    for (const std::uint32_t seed : {0U, 1U, 0x12345678U, 0xffffffffU}) {
        for (int m = 0; m <= 8; ++m) {
            const std::uint32_t points = 1U << m;
            for (const std::uint32_t first : {0U, points, 7 * points}) {
                for (int across = 0; across <= m; ++across) {
                    std::set<std::pair<int, int>> boxes;
                    for (std::uint32_t i = 0; i < points; ++i) {
                        const glm::vec2 p = scrambledSobolPair(first + i, seed);
                        ASSERT_GE(p.x, 0);
                        ASSERT_LT(p.x, 1);
                        boxes.insert(
                            {static_cast<int>(std::ldexp(p.x, across)), static_cast<int>(std::ldexp(p.y, m - across))});
                    }
                    EXPECT_EQ(boxes.size(), points) << "seed " << seed << ", m " << m << ", " << across;
                }
            }
        }
    }
}

TEST(LowDiscrepancy, PointsOfTwoSeedsPairUpWithoutPattern) {
    // The correlation of n independent pairs has a deviation of 1 / sqrt(n); 4.5 of them for 40 tries.
    constexpr int kPoints = 4096;
    for (std::uint32_t seed = 0; seed < 40; ++seed) {
        double sum = 0;
        for (std::uint32_t i = 0; i < kPoints; ++i) {
            sum +=
                12 * (scrambledSobolPair(i, childSeed(1, seed)).x - 0.5) * (scrambledSobolPair(i, childSeed(2, seed)).x - 0.5);
        }
        EXPECT_LT(std::abs(sum / kPoints), 4.5 / std::sqrt(kPoints)) << seed;
    }
}

/// The cosine-weighted visibility of a half plane: 1 where x < 0.3, smooth otherwise.
double integrand(const glm::dvec2& p) { return p.x < 0.3 ? p.y : std::sin(3 * p.x) * p.y * p.y; }

TEST(LowDiscrepancy, HalfTheSamplesReachTheErrorOfRandomOnes) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform;
    constexpr int kTrials = 400, kSamples = 64;
    const double exact = 0.15 + (std::cos(0.9) - std::cos(3.0)) / 9;
    double random_squares = 0, net_squares = 0;
    for (int trial = 0; trial < kTrials; ++trial) {
        double by_random = 0, by_net = 0;
        for (int i = 0; i < kSamples; ++i) by_random += integrand({uniform(random), uniform(random)});
        for (std::uint32_t i = 0; i < kSamples / 2; ++i) {
            by_net += integrand(scrambledSobolPair(i, childSeed(9, static_cast<std::uint32_t>(trial))));
        }
        random_squares += std::pow(by_random / kSamples - exact, 2);
        net_squares += std::pow(by_net / (kSamples / 2) - exact, 2);
    }
    EXPECT_LT(net_squares, random_squares);
    EXPECT_LT(std::sqrt(net_squares / kTrials), 0.5 * std::sqrt(random_squares / kTrials)) << "much better where it is smooth";
}

TEST(LowDiscrepancy, ReplicatesGiveACalibratedStandardError) {
    // With four replicates, 95 % of errors are within 3.18 standard errors (Student's t, 3 degrees of freedom).
    constexpr int kTrials = 2000;
    const double exact = 0.15 + (std::cos(0.9) - std::cos(3.0)) / 9;
    int within = 0;
    for (int trial = 0; trial < kTrials; ++trial) {
        std::vector<double> means(kReplicates, 0.0);
        for (std::uint32_t r = 0; r < kReplicates; ++r) {
            const std::uint32_t seed = childSeed(static_cast<std::uint32_t>(trial), r);
            for (std::uint32_t i = 0; i < 16; ++i) means[r] += integrand(scrambledSobolPair(i, seed)) / 16;
        }
        const ReplicatedMean mean = replicatedMean(means);
        within += std::abs(mean.mean - exact) <= 3.182 * mean.standard_error;
    }
    EXPECT_NEAR(within, 0.95 * kTrials, 0.02 * kTrials);
}

TEST(LowDiscrepancy, StandardErrorOfKnownReplicates) {
    const std::vector<double> three{1, 2, 6};
    EXPECT_DOUBLE_EQ(replicatedMean(three).mean, 3);
    EXPECT_NEAR(replicatedMean(three).standard_error, std::sqrt(14.0 / 6), 1e-15);
    EXPECT_EQ(replicatedMean(std::vector<double>{5}).standard_error, 0);
    EXPECT_EQ(replicatedMean({}).mean, 0);
}

}  // namespace
}  // namespace radiata
