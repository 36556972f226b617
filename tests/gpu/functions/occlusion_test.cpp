// Rays that only ask whether a glyph is in their way, from its own surface and from elsewhere, against every hit found in
// double. Without exception for rays whose answer stands when they move by 1e-5 radii.
#include <array>
#include <cmath>
#include <cstdio>

#include "gpu/functions/march_runner.h"
#include "math/sh_evaluate.h"
#include "reference/visibility.h"
#include "shaders/test/visibility_io.glsl"

namespace radiata {
namespace {

using namespace test;
using shader::OcclusionInput;
using shader::OcclusionOutput;

const std::vector<ShLayout> kLayouts{{4, false}, {8, false}, {16, false}, {8, true}};
constexpr std::array kSources{"samples", "table of the origin", "table of the direction"};

glm::vec3 unitVector(std::mt19937& random) {
    std::normal_distribution<float> normal;
    return glm::normalize(glm::vec3(normal(random), normal(random), normal(random)));
}

/// The band-limited delta along an axis: amplitude 1 there, and the narrowest lobe of its bands.
std::vector<float> thinLobe(ShLayout layout, const glm::dvec3& axis) {
    std::vector<double> basis(layout.count());
    evaluateSh(layout, axis, basis);
    double peak = 0;
    for (const double value : basis) peak += value * value;
    std::vector<float> glyph;
    for (const double value : basis) glyph.push_back(static_cast<float>(value / peak));
    return glyph;
}

class Occlusion : public FunctionTest {
protected:
    std::vector<OcclusionOutput> occlusion(ShLayout layout, const std::vector<float>& glyph,
                                           const std::vector<OcclusionInput>& rays, std::uint32_t source) {
        const BoundsEvaluator evaluator(layout);
        std::vector<float> shared = glyph;
        shared.push_back(certifiedRadius(evaluator, glyph));
        const auto outputs = runFunction<OcclusionOutput>("test_occlusion_" + nameOf(layout), {source}, rays, shared);
        for (const OcclusionOutput& output : outputs) EXPECT_EQ(output.capped, 0U);
        return outputs;
    }

    /// A ray from the surface that leaves it, or one that starts in the open near the glyph; some end.
    static OcclusionInput makeRay(std::mt19937& random, const reference::ShFunction& f, bool on_surface) {
        std::uniform_real_distribution<float> unit(0, 1);
        OcclusionInput ray{};
        for (;;) {
            ray.both_lobes = unit(random) < 0.5F;
            ray.on_surface = on_surface;
            ray.t_max = unit(random) < 0.3F ? unit(random) : 1e30F;
            const glm::dvec3 p = unitVector(random);
            const double amplitude = f(p);
            if (amplitude <= 0 && (on_surface && ray.both_lobes == 0)) continue;
            ray.direction = unitVector(random);
            if (!on_surface) {
                ray.origin = glm::vec3(p * (std::abs(amplitude) + 0.02 + 2.0 * unit(random)));
                ray.direction = glm::normalize(0.5F * unitVector(random) - ray.origin);
                return ray;
            }
            ray.origin = glm::vec3(std::abs(amplitude) * p);
            const double slope = glm::dot(reference::glyphNormal(f, p), glm::dvec3(ray.direction));
            if (slope < 0) ray.direction = -ray.direction;
            if (std::abs(slope) > 0.02 && std::abs(amplitude) > 0.02) return ray;
        }
    }

    void compareAll(bool on_surface, int blocked_least) {
        std::mt19937 random(31);
        for (const ShLayout layout : kLayouts) {
            int rays_sure = 0, blocked = 0;
            std::array<int, 3> wrong{};
            for (int glyph_number = 0; glyph_number < 3; ++glyph_number) {
                const std::vector<float> glyph = randomGlyph(random, layout);
                const reference::ShFunction f(layout, glyph);
                std::vector<OcclusionInput> rays;
                for (int i = 0; i < 300; ++i) rays.push_back(makeRay(random, f, on_surface));
                std::array<std::vector<OcclusionOutput>, 3> outputs;
                for (std::uint32_t source = 0; source < 3; ++source) outputs[source] = occlusion(layout, glyph, rays, source);
                const reference::PlacedGlyph placed{&f, glm::dvec3(0), 1};
                for (std::size_t i = 0; i < rays.size(); ++i) {
                    const reference::Visibility expected =
                        reference::visibilityOf({&placed, 1}, rays[i].origin, glm::normalize(glm::dvec3(rays[i].direction)),
                                                rays[i].both_lobes != 0, on_surface ? 0 : -1, rays[i].t_max);
                    if (!expected.sure) continue;
                    ++rays_sure;
                    blocked += expected.blocked;
                    for (std::size_t source = 0; source < 3; ++source) {
                        wrong[source] += (outputs[source][i].blocked != 0) != expected.blocked;
                    }
                }
            }
            for (std::size_t source = 0; source < 3; ++source) {
                EXPECT_EQ(wrong[source], 0) << nameOf(layout) << " by " << kSources[source];
            }
            EXPECT_GE(rays_sure, 800);
            EXPECT_GE(blocked, blocked_least) << nameOf(layout);
            std::printf("%s, %s: %d rays, %d blocked\n", on_surface ? "from the surface" : "from elsewhere",
                        nameOf(layout).c_str(), rays_sure, blocked);
        }
    }
};

TEST_F(Occlusion, FromTheGlyphsOwnSurfaceIsThatOfTheTwin) { compareAll(true, 30); }

TEST_F(Occlusion, FromElsewhereIsThatOfTheTwin) { compareAll(false, 150); }

/// A convex glyph never shadows a point from which the ray leaves, and no ray escapes inwards.
TEST_F(Occlusion, AConvexGlyphNeverShadowsItsOwnLitSide) {
    std::mt19937 random(32);
    for (const ShLayout layout : kLayouts) {
        std::vector<float> glyph(layout.count(), 0.0F);
        glyph[0] = 1;
        for (int m = -2; m <= 2; ++m) glyph[layout.index(2, m)] = 0.01F * static_cast<float>(m + 1);
        if (layout.full) glyph[layout.index(1, 0)] = 0.1F;
        const reference::ShFunction f(layout, glyph);
        std::vector<OcclusionInput> out, in;
        for (int i = 0; i < 4000; ++i) {
            const glm::dvec3 p = unitVector(random);
            const glm::dvec3 normal = reference::glyphNormal(f, p);
            const glm::dvec3 tangent = glm::normalize(glm::cross(normal, glm::dvec3(unitVector(random))));
            // From 1e-4 over the horizon up to the normal, and the direction away from the centre.
            const double height = std::pow(10.0, -4.0 * (i % 100) / 99.0);
            const glm::dvec3 direction = i % 10 == 0 ? p : height * normal + std::sqrt(1 - height * height) * tangent;
            OcclusionInput ray{glm::vec3(f(p) * p), 0, glm::vec3(direction), 1e30F, 1};
            out.push_back(ray);
            ray.direction = -ray.direction;
            // Flatter ones stay within 1e-7 of the surface, which is nothing in float32.
            if (height > 1e-3) in.push_back(ray);
        }
        for (std::uint32_t source = 0; source < 3; ++source) {
            int shadowed = 0, leaking = 0;
            for (const OcclusionOutput& output : occlusion(layout, glyph, out, source)) shadowed += output.blocked != 0;
            for (const OcclusionOutput& output : occlusion(layout, glyph, in, source)) leaking += output.blocked == 0;
            EXPECT_EQ(shadowed, 0) << nameOf(layout) << " by " << kSources[source];
            EXPECT_EQ(leaking, 0) << nameOf(layout) << " by " << kSources[source];
        }
    }
}

/// Rays across a lobe as thin as the band allows, at 5 to 95 % of its length, from close by.
TEST_F(Occlusion, NoLightLeaksThroughThinLobes) {
    std::mt19937 random(33);
    std::uniform_real_distribution<float> unit(0, 1);
    for (const ShLayout layout : kLayouts) {
        const glm::dvec3 axis = glm::normalize(glm::dvec3(0.4, -0.3, 0.86));
        const std::vector<float> glyph = thinLobe(layout, axis);
        std::vector<OcclusionInput> rays;
        for (int i = 0; i < 4000; ++i) {
            const glm::dvec3 across = glm::normalize(glm::cross(axis, glm::dvec3(unitVector(random))));
            const glm::dvec3 place = (0.05 + 0.9 * unit(random)) * axis;
            rays.push_back({glm::vec3(place - (0.6 + unit(random)) * across), 0, glm::vec3(across), 1e30F, 0});
        }
        for (std::uint32_t source = 0; source < 3; ++source) {
            int leaking = 0;
            for (const OcclusionOutput& output : occlusion(layout, glyph, rays, source)) leaking += output.blocked == 0;
            EXPECT_EQ(leaking, 0) << nameOf(layout) << " by " << kSources[source];
        }
    }
}

}  // namespace
}  // namespace radiata
