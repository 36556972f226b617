#include "reference/glyph_hits.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "random_glyphs.h"

namespace radiata::reference {
namespace {

using test::randomCoefficients;
using test::uniform;
using test::unitVector;

const double kSphere = 2 * std::sqrt(std::numbers::pi);  // coefficient of the unit sphere

TEST(GlyphHits, FindsBothSidesOfASphere) {
    const ShFunction f({0, false}, std::vector<double>{kSphere});
    const GlyphHits far = glyphHits(f, {0.6, 0, 10}, {0, 0, -1}, false);
    ASSERT_EQ(far.hits.size(), 2U);
    EXPECT_NEAR(far.hits[0].t, 9.2, 1e-13);
    EXPECT_NEAR(far.hits[1].t, 10.8, 1e-13);
    EXPECT_LT(glm::length(far.hits[0].normal - glm::dvec3(0.6, 0, 0.8)), 1e-13);
    EXPECT_FALSE(far.grazing);
    const GlyphHits inside = glyphHits(f, {0.6, 0, 0}, {0, 0, -1}, false, 0);
    ASSERT_EQ(inside.hits.size(), 1U);
    EXPECT_NEAR(inside.hits[0].t, 0.8, 1e-13);
    EXPECT_TRUE(glyphHits(f, {1.2, 0, 10}, {0, 0, -1}, true).hits.empty());
}

TEST(GlyphHits, FlagsTangentsAndNothingNearby) {
    const ShFunction f({0, false}, std::vector<double>{kSphere});
    for (const double height : {1 - 5e-6, 1.0, 1 + 5e-6}) {
        EXPECT_TRUE(glyphHits(f, {height, 0, 5}, {0, 0, -1}, false).grazing) << height;
    }
    for (const double height : {0.999, 1.001}) {
        EXPECT_FALSE(glyphHits(f, {height, 0, 5}, {0, 0, -1}, false).grazing) << height;
    }
}

TEST(GlyphHits, ThroughTheExactCentreHitsTheEndsOfTheLobes) {
    std::mt19937_64 random(4);
    for (const ShLayout layout : {ShLayout{8, false}, ShLayout{7, true}}) {
        const ShFunction f(layout, randomCoefficients(random, layout));
        for (int i = 0; i < 20; ++i) {
            const glm::dvec3 d = unitVector(random);
            const GlyphHits all = glyphHits(f, -3.0 * d, d, true);
            ASSERT_EQ(all.hits.size(), 2U);
            EXPECT_NEAR(all.hits.front().t, 3 - std::abs(f(-d)), 1e-13);
            EXPECT_NEAR(all.hits.back().t, 3 + std::abs(f(d)), 1e-13);
        }
        const GlyphHits exact = glyphHits(f, {0, 0, 4}, {0, 0, -1}, true);
        ASSERT_EQ(exact.hits.size(), 2U);
        EXPECT_NEAR(exact.hits[0].t, 4 - std::abs(f({0, 0, 1})), 1e-14);
    }
}

TEST(GlyphHits, LieOnTheSurfaceAndCountAgreesWithAFineScan) {
    std::mt19937_64 random(5);
    int compared = 0;
    for (const ShLayout layout : {ShLayout{4, false}, ShLayout{12, false}, ShLayout{16, false}, ShLayout{5, true}}) {
        for (int glyph = 0; glyph < 5; ++glyph) {
            const ShFunction f(layout, randomCoefficients(random, layout));
            for (int ray = 0; ray < 10; ++ray) {
                const glm::dvec3 d = unitVector(random);
                const glm::dvec3 origin = anyOrthogonal(d) * uniform(random, 0.02, 0.5) - 4.0 * d;
                const bool both = ray % 2 == 0;
                const GlyphHits found = glyphHits(f, origin, d, both);
                for (const GlyphHit& hit : found.hits) {
                    const glm::dvec3 p = origin + hit.t * d;
                    EXPECT_NEAR(glm::length(p), std::abs(f(p)), 1e-12);
                    EXPECT_TRUE(both || hit.amplitude > 0);
                    EXPECT_NEAR(hit.amplitude, f(p), 1e-12);
                }
                if (found.grazing) continue;
                std::size_t crossings = 0;
                bool was_inside = false;
                for (int i = 0; i <= 20000; ++i) {
                    const glm::dvec3 p = origin + (2 + i * 2e-4) * d;
                    const bool inside = glm::length(p) < (both ? std::abs(f(p)) : f(p));
                    crossings += inside != was_inside;
                    was_inside = inside;
                }
                EXPECT_EQ(found.hits.size(), crossings) << layout.lmax;
                ++compared;
            }
        }
    }
    EXPECT_GT(compared, 150);
}

TEST(GlyphHits, FindsTheTenHitsOfPeters2023Figure2) {
    // Ten is the most that band 4 allows; the search runs over random glyphs and rays near the centre.
    std::mt19937_64 random(6);
    std::size_t most = 0;
    for (int attempt = 0; attempt < 4000 && most < 10; ++attempt) {
        std::vector<double> c(15);
        for (double& value : c) value = uniform(random, -1, 1);
        c[0] *= 0.3;
        const ShFunction f({4, false}, c);
        const glm::dvec3 d = unitVector(random);
        const GlyphHits found = glyphHits(f, anyOrthogonal(d) * uniform(random, 0.01, 0.2) - 5.0 * d, d, true);
        ASSERT_LE(found.hits.size(), 10U);
        if (!found.grazing) most = std::max(most, found.hits.size());
    }
    EXPECT_EQ(most, 10U);
}

TEST(GlyphNormal, IsOrthogonalToTheSurfaceAndPointsOutwards) {
    std::mt19937_64 random(7);
    for (const ShLayout layout : {ShLayout{8, false}, ShLayout{5, true}}) {
        const ShFunction f(layout, randomCoefficients(random, layout));
        for (int i = 0; i < 50; ++i) {
            const glm::dvec3 p = unitVector(random), tangent = anyOrthogonal(p);
            if (std::abs(f(p)) < 0.05) continue;
            const glm::dvec3 normal = glyphNormal(f, p);
            const double h = 1e-6;
            const glm::dvec3 ahead = glm::normalize(p + h * tangent), behind = glm::normalize(p - h * tangent);
            const glm::dvec3 along = glm::normalize(std::abs(f(ahead)) * ahead - std::abs(f(behind)) * behind);
            EXPECT_NEAR(glm::dot(normal, along), 0, 1e-6);
            EXPECT_GT(glm::dot(normal, p), 0);
        }
    }
}

}  // namespace
}  // namespace radiata::reference
