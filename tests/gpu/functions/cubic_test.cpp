// Chords through trilinear cells: first roots against subdivision in double. A third of the cells is random, a third nearly
// planar, a third like computed tomography, numbers around 1000. radiata-lab run isosurface-hits does the same over four
// million.
#include "reference/cubic.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "gpu/functions/function_runner.h"
#include "shaders/test/isosurface_io.glsl"

namespace radiata {
namespace {

using shader::CubicInput;
using CubicFunctions = test::FunctionTest;

glm::vec3 onFace(std::mt19937& random, int& face) {
    std::uniform_real_distribution<float> unit(0, 1);
    face = static_cast<int>(random() % 6);
    glm::vec3 p(unit(random), unit(random), unit(random));
    p[face / 2] = face % 2 ? 1.0F : 0.0F;
    return p;
}

std::vector<CubicInput> randomChords(std::size_t count) {
    std::mt19937 random(17);
    std::uniform_real_distribution<float> unit(0, 1), sign(-1, 1);
    std::vector<CubicInput> chords(count);
    for (std::size_t i = 0; i < count; ++i) {
        CubicInput& x = chords[i];
        x.isovalue = i % 3 == 2 ? 1000 + 20 * sign(random) : 0;
        const glm::vec3 slope(sign(random), sign(random), sign(random));
        const float offset = -glm::dot(slope, glm::vec3(unit(random), unit(random), unit(random)));
        for (int n = 0; n < 8; ++n) {
            const glm::vec3 corner(n & 1, n >> 1 & 1, n >> 2);
            const float planar = glm::dot(slope, corner) + offset;
            x.corners[n] = i % 3 == 0   ? sign(random)
                           : i % 3 == 1 ? planar + 1e-3F * sign(random)
                                        : 1000 + std::round(60 * sign(random));
        }
        int first = 0, second = 0;
        x.from = onFace(random, first);
        do x.to = onFace(random, second);
        while (first == second);
    }
    return chords;
}

TEST_F(CubicFunctions, FirstRootsAgreeWithSubdivision) {
    const std::vector<CubicInput> chords = randomChords(300'000);
    const std::vector<float> roots = runFunction<float>("test_cubic", {}, chords);
    std::vector<double> errors;
    std::size_t missed = 0, invented = 0, hits = 0, even = 0;
    for (std::size_t i = 0; i < chords.size(); ++i) {
        const CubicInput& x = chords[i];
        std::array<double, 8> corners{};
        std::copy(x.corners, x.corners + 8, corners.begin());
        const auto expected = reference::firstChordRoot(corners, x.isovalue, x.from, x.to);
        // Less than this is within the rounding of the corners' sums in float.
        const double rounding = 2e-6 * (1 + *std::max_element(corners.begin(), corners.end(), [](double a, double b) {
                                            return std::abs(a) < std::abs(b);
                                        }) * 0.02);
        if (roots[i] >= 0 && !expected) {
            const double value =
                reference::cellValue(corners, glm::mix(glm::dvec3(x.from), glm::dvec3(x.to), double(roots[i]))) - x.isovalue;
            invented += std::abs(value) > rounding ? 1 : 0;
        }
        if (!expected || expected->margin < rounding) continue;
        ++hits;
        if (roots[i] < 0) {
            ++missed;
            continue;
        }
        errors.push_back(std::abs(roots[i] - expected->u) * glm::length(glm::dvec3(x.to) - glm::dvec3(x.from)));
        const double ends =
            (reference::cellValue(corners, x.from) - x.isovalue) * (reference::cellValue(corners, x.to) - x.isovalue);
        even += ends > 0 ? 1 : 0;
    }
    std::ranges::sort(errors);
    const double p9999 = errors[errors.size() * 9999 / 10000];
    std::printf("%zu hits, %zu of them between ends of one sign; error median %.2g, p99 %.2g, p99.99 %.2g, most %.2g cells\n",
                hits, even, errors[errors.size() / 2], errors[errors.size() * 99 / 100], p9999, errors.back());
    EXPECT_EQ(missed, 0U);
    EXPECT_EQ(invented, 0U);
    EXPECT_GT(even, hits / 100);
    EXPECT_LT(errors[errors.size() / 2], 1e-6);
    EXPECT_LT(p9999, 2e-5);
}

CubicInput chord(const std::array<float, 8>& corners, float isovalue, const glm::vec3& from, const glm::vec3& to) {
    CubicInput x{};
    std::copy(corners.begin(), corners.end(), x.corners);
    x.isovalue = isovalue;
    x.from = from;
    x.to = to;
    return x;
}

TEST_F(CubicFunctions, DegenerateCellsHaveTheAnswersOfTheirFormulas) {
    const std::array<float, 8> ramp{0, 1, 0, 1, 0, 1, 0, 1}, saddle{1, -2, -2, 1, 1, -2, -2, 1};
    const glm::vec3 left(0, 0.5F, 0.5F), right(1, 0.5F, 0.5F);
    const std::vector<CubicInput> chords{
        chord({3, 3, 3, 3, 3, 3, 3, 3}, 3, left, right),      // all equal to the isovalue: all inside
        chord({3, 3, 3, 3, 3, 3, 3, 3}, 2, left, right),      // all above
        chord(ramp, 0, left, right),                          // the isovalue at the first corner: never outside
        chord(ramp, 1, left, right),                          // at the last: reached at the very end
        chord(ramp, 0.25F, left, right),                      // linear
        chord(ramp, 0.25F, {0, 0, 0}, {1, 0, 0}),             // along an edge
        chord(saddle, 0, {0, 0, 0.5F}, {1, 1, 0.5F}),         // two roots between ends of one sign
        chord(ramp, 0.5F, {0.5F, 0, 0.5F}, {0.5F, 1, 0.5F}),  // within the surface: no slope at all
        chord(ramp, 0.5F, left, left),                        // no length
        chord({0, 1e30F, 0, 1e30F, 0, 1e30F, 0, 1e30F}, 2.5e29F, left, right),  // squares would not fit a float
        chord({0, 1e-30F, 0, 1e-30F, 0, 1e-30F, 0, 1e-30F}, 2.5e-31F, left, right),
    };
    const std::vector<float> roots = runFunction<float>("test_cubic", {}, chords);
    const std::vector<double> expected{-1, -1, -1, 1, 0.25, 0.25, 0.5 - std::sqrt(0.25 - 1.0 / 6), -1, -1, 0.25, 0.25};
    for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(roots[i], expected[i], 1e-6) << i;
}

}  // namespace
}  // namespace radiata
