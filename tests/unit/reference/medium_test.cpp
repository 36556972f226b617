// Media by small pieces of a ray against closed forms.
#include "reference/medium.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "reference/inside_length.h"
#include "unit/reference/random_glyphs.h"

namespace radiata::reference {
namespace {

using namespace test;

constexpr int kSteps = 20'000;

TEST(Medium, OfOneEmissionIsTheExponentialOfTheSummedLength) {
    std::mt19937_64 random(51);
    const ShLayout layout{4, false};
    int overlapping = 0;
    for (int i = 0; i < 30; ++i) {
        std::vector<double> a = randomCoefficients(random, layout), b = randomCoefficients(random, layout);
        a[0] = b[0] = 2;
        const ShFunction f(layout, a), g(layout, b);
        const glm::dvec3 emission(0.2, 0.5, 0.7), behind(0.9, 0.1, 0.3), d = unitVector(random);
        const std::vector<MediumGlyph> glyphs{{&f, {0, 0, 0}, 1.5, 0.8, emission},
                                              {&g, 0.4 * unitVector(random), 1, 0.8, emission}};
        const glm::dvec3 origin = 0.2 * unitVector(random) - 3.0 * d;
        double lengths[2];
        for (int k = 0; k < 2; ++k) {
            const MediumGlyph& glyph = glyphs[static_cast<std::size_t>(k)];
            lengths[k] =
                glyph.scale * insideLength(*glyph.function, (origin - glyph.centre) / glyph.scale, d, 0, 6 / glyph.scale, true);
        }
        overlapping += lengths[0] > 0 && lengths[1] > 0;
        const double transmittance = std::exp(-0.8 * (lengths[0] + lengths[1]));
        const glm::dvec3 expected = transmittance * behind + (1 - transmittance) * emission;
        const glm::dvec3 found = throughMedia(glyphs, origin, d, 0, 6, true, behind, kSteps);
        // A crossing is off by half a step at most, and there are no more than twenty.
        EXPECT_LE(glm::length(found - expected), 20 * 0.8 * 6.0 / kSteps);
    }
    EXPECT_GT(overlapping, 15);
}

TEST(Medium, OfTwoEmissionsIsNearlyTheirMixtureWhereItIsThinAndOrderedWhereItIsDense) {
    const double one = std::sqrt(4 * std::numbers::pi);
    const ShFunction ball({0, false}, std::vector<double>{one});
    const glm::dvec3 red(1, 0, 0), blue(0, 0, 1), black(0);
    const auto through = [&](double extinction) {
        const std::vector<MediumGlyph> glyphs{{&ball, {0, 0, 0}, 1, extinction, red}, {&ball, {0, 0, 2}, 1, extinction, blue}};
        return throughMedia(glyphs, {0, 0, -3}, {0, 0, 1}, 0, 8, false, black, kSteps);
    };
    // What the shader makes of it: both emissions by optical depth.
    const auto mixed = [&](double extinction) { return (red + blue) * 0.5 * (1 - std::exp(-4 * extinction)); };
    EXPECT_LE(glm::length(through(0.01) - mixed(0.01)), 0.001);
    const glm::dvec3 dense = through(2);
    EXPECT_NEAR(dense.x, 1 - std::exp(-4.0), 1e-2);
    EXPECT_NEAR(dense.z, std::exp(-4.0) * (1 - std::exp(-4.0)), 1e-2);
}

}  // namespace
}  // namespace radiata::reference
