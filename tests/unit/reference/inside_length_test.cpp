// The length of rays inside of a glyph against plain sampling of the rays.
#include "reference/inside_length.h"

#include <cmath>

#include <gtest/gtest.h>

#include "unit/reference/random_glyphs.h"

namespace radiata::reference {
namespace {

using namespace test;

TEST(InsideLength, AgreesWithPlainSampling) {
    std::mt19937_64 random(41);
    int inside_rays = 0;
    for (const ShLayout layout : {ShLayout{2, false}, ShLayout{8, false}, ShLayout{5, true}}) {
        for (int i = 0; i < 40; ++i) {
            const ShFunction f(layout, randomCoefficients(random, layout));
            const glm::dvec3 d = unitVector(random);
            const glm::dvec3 origin = uniform(random, 0, 0.2) * anyOrthogonal(d) + uniform(random, -1, 1) * d;
            const bool both = i % 2 == 0;
            const double begin = uniform(random, -2, 0), end = begin + uniform(random, 0, 5);
            // Each crossing is off by at most one of the samples.
            constexpr int kSamples = 20000;
            int inside = 0, crossings = 2;
            bool before = false;
            for (int k = 0; k < kSamples; ++k) {
                const bool now = insideGlyph(f, origin + (begin + (end - begin) * (k + 0.5) / kSamples) * d, both);
                inside += now;
                crossings += now != before;
                before = now;
            }
            inside_rays += inside > 0;
            EXPECT_NEAR(insideLength(f, origin, d, begin, end, both), (end - begin) * inside / kSamples,
                        (end - begin) * crossings / kSamples);
        }
    }
    EXPECT_GT(inside_rays, 30);
}

TEST(InsideLength, OfAConstantIsAChord) {
    const double c = std::sqrt(4 * 3.14159265358979323846);  // amplitude 1
    const ShFunction f({0, false}, std::vector<double>{c});
    EXPECT_NEAR(insideLength(f, {0.6, 0, -3}, {0, 0, 1}, 0, 9, false), 1.6, 1e-12);
    EXPECT_NEAR(insideLength(f, {0, 0, -3}, {0, 0, 1}, 0, 9, false), 2, 1e-12) << "through the centre";
    EXPECT_NEAR(insideLength(f, {0, 0, 0}, {0, 0, 1}, 0, 9, true), 1, 1e-12) << "from the centre";
    EXPECT_NEAR(insideLength(f, {0, 0, -3}, {0, 0, 1}, 0, 2.5, true), 0.5, 1e-12);
    EXPECT_EQ(insideLength(f, {0, 0, -3}, {0, 0, 1}, 0, 1, true), 0);
    EXPECT_EQ(insideLength(f, {0, 0, -3}, {0, 0, 1}, 3, 3, true), 0);
    const ShFunction negative({0, false}, std::vector<double>{-c});
    EXPECT_EQ(insideLength(negative, {0, 0, -3}, {0, 0, 1}, 0, 9, false), 0);
    EXPECT_NEAR(insideLength(negative, {0, 0, -3}, {0, 0, 1}, 0, 9, true), 2, 1e-12);
}

}  // namespace
}  // namespace radiata::reference
