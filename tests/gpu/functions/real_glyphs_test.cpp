// First hits and normals of the march on glyphs of a brain: no miss, t within 2e-5 glyph radii, normals within 0.1 degree, for
// all rays that do not graze. Normals of hits within 0.01 radii of the centre, where the direction to the hit hangs on the
// rounding of the ray, are held to 0.1 degree times 0.01 radii / distance. As in the picture, they are turned towards the
// viewer. Measured glyphs against hits found by brute force outside of this project (folder RADIATA_DATA), and in any case
// glyphs of the phantom against the reference.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <numbers>
#include <optional>

#include "build/phantom.h"
#include "gpu/functions/march_runner.h"
#include "math/sh_convention.h"
#include "support/npz.h"

namespace radiata {
namespace {

using namespace test;

struct Tally {
    int rays = 0, hits = 0, wrong = 0, more = 0;
    double t = 0;                            // largest error, radii
    double degrees = 0, degrees_centre = 0;  // of normals, beyond and within 0.01 radii of the centre
};

/// The first hit that counts.
std::optional<reference::GlyphHit> firstOf(const std::vector<reference::GlyphHit>& hits, bool both_lobes) {
    for (const reference::GlyphHit& hit : hits) {
        if (both_lobes || hit.amplitude > 0) return hit;
    }
    return std::nullopt;
}

class RealGlyphs : public MarchTest {
protected:
    /// \param expected  all hits of each ray, ascending; rays come twice, first with positive lobes only, then with both
    void compareHits(ShLayout layout, const std::vector<float>& glyph, const BoundsEvaluator& evaluator,
                     std::vector<RayInput> rays, const std::vector<std::vector<reference::GlyphHit>>& expected, Tally& tally) {
        const std::size_t count = rays.size();
        if (count == 0) return;
        rays.insert(rays.end(), rays.begin(), rays.end());
        for (std::size_t i = 0; i < rays.size(); ++i) rays[i].both_lobes = i < count ? 0 : 1;
        const float radius = certifiedRadius(evaluator, glyph);
        const auto outputs = march(layout, glyph, radius, rays);
        const auto found_normals = normals(layout, glyph, outputs);
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const auto first = firstOf(expected[i % count], i >= count);
            const bool hit = outputs[i].amplitude != 0;
            ++tally.rays;
            if (hit != first.has_value()) {
                ++tally.wrong;
                ADD_FAILURE() << "ray " << i % count << (hit ? ": hit where there is none" : ": missed") << ", both lobes "
                              << (i >= count);
                continue;
            }
            if (!hit) continue;
            ++tally.hits;
            const double error = std::abs(double(outputs[i].t) - first->t) / double(radius);
            const glm::dvec3 d(rays[i].direction), o(rays[i].origin);
            const auto towardsViewer = [&d](const glm::dvec3& n) { return glm::dot(n, d) > 0 ? -n : n; };
            const double turned = 180 / std::numbers::pi *
                                  glm::length(towardsViewer(glm::dvec3(found_normals[i])) - towardsViewer(first->normal));
            const double distance = glm::length(o + first->t * d) / double(radius);
            const double allowed = 0.1 * std::max(1.0, 0.01 / distance);
            double& worst = distance < 0.01 ? tally.degrees_centre : tally.degrees;
            worst = std::max(worst, turned);
            EXPECT_LT(error, 2e-5) << "ray " << i % count << ", both lobes " << (i >= count);
            EXPECT_LT(turned, allowed) << "distance " << distance << ", "
                                       << "ray " << i % count << ", both lobes " << (i >= count);
            tally.wrong += !(error < 2e-5 && turned < allowed);
            tally.t = std::max(tally.t, error);
        }
    }

    static void print(const char* name, int lmax, const Tally& tally) {
        std::printf(
            "%s %d: %d rays, %d hits, %d wrong; worst t %.2g radii, worst normal %.2g degrees, %.2g near the centre; "
            "%d rays with more hits than the file has\n",
            name, lmax, tally.rays, tally.hits, tally.wrong, tally.t, tally.degrees, tally.degrees_centre, tally.more);
    }

    void compareWithFile(const std::filesystem::path& path, int lmax) {
        const testing::NpzFile file(path);
        const ShLayout layout{lmax, false};
        const auto coefficients = file.array("coef_mrtrix"), origins = file.array("ray_o"), directions = file.array("ray_d"),
                   times = file.array("hit_t"), signs = file.array("hit_sign"), normals = file.array("hit_normal"),
                   graze = file.array("graze");
        const auto vectorAt = [](const testing::NpyArray& array, std::size_t i) {
            return glm::dvec3(array.values[3 * i], array.values[3 * i + 1], array.values[3 * i + 2]);
        };
        const std::size_t glyphs = times.shape.at(0), rays = times.shape.at(1), slots = times.shape.at(2);
        const BoundsEvaluator evaluator(layout);
        Tally tally;
        for (std::size_t g = 0; g < glyphs; ++g) {
            SCOPED_TRACE("k " + std::to_string(lmax) + ", glyph " + std::to_string(g));
            const auto first = coefficients.values.begin() + std::ptrdiff_t(g * layout.count());
            std::vector<float> glyph(first, first + std::ptrdiff_t(layout.count()));
            convertSh(std::span<float>(glyph), layout, ShConvention::kTournier07, ShConvention::kDescoteaux07);
            const reference::ShFunction f(layout, glyph);
            std::vector<RayInput> inputs;
            std::vector<std::vector<reference::GlyphHit>> expected;
            for (std::size_t r = g * rays; r < (g + 1) * rays; ++r) {
                if (graze.values[r] != 0) continue;
                std::vector<reference::GlyphHit> hits;
                for (std::size_t slot = r * slots; slot < (r + 1) * slots && !std::isnan(times.values[slot]); ++slot) {
                    hits.push_back({times.values[slot], signs.values[slot], vectorAt(normals, slot)});
                }
                // The file was made by sampling along the ray, which loses pairs of hits that lie close together at the centre.
                const auto all = reference::glyphHits(f, vectorAt(origins, r), vectorAt(directions, r), true);
                if (all.hits.size() > hits.size()) {
                    ++tally.more;
                    hits = all.hits;
                }
                expected.push_back(std::move(hits));
                inputs.push_back({vectorAt(origins, r), -1e3F, vectorAt(directions, r), 0});
            }
            compareHits(layout, glyph, evaluator, inputs, expected, tally);
        }
        print(path.filename().c_str(), lmax, tally);
        EXPECT_GT(tally.hits, int(glyphs * rays) / 2);
    }

    void compareWithPhantom(int lmax) {
        PhantomOptions options;
        options.size = 20;
        options.lmax = lmax;
        options.noise = 0.02;
        const model::ShImage image = phantomShImage(options);
        const ShLayout layout = image.layout;
        const BoundsEvaluator evaluator(layout);
        std::mt19937 random(23);
        Tally tally;
        const std::size_t glyphs = 12;
        for (std::size_t g = 0; g < glyphs; ++g) {
            SCOPED_TRACE("phantom, k " + std::to_string(lmax) + ", glyph " + std::to_string(g));
            const std::size_t voxel = g * image.voxels.size() / glyphs;
            const float* first = &image.coefficients[voxel * layout.count()];
            const std::vector<float> glyph(first, first + layout.count());
            const reference::ShFunction f(layout, glyph);
            const float radius = certifiedRadius(evaluator, glyph);
            std::vector<RayInput> inputs;
            std::vector<std::vector<reference::GlyphHit>> expected;
            for (RayInput ray : randomRays(random, 64, 0.01F, 0.9F)) {
                ray.origin *= radius;
                ray.t_min = -1e3F;
                const auto all =
                    reference::glyphHits(f, glm::dvec3(ray.origin), glm::normalize(glm::dvec3(ray.direction)), true);
                if (all.grazing) continue;
                inputs.push_back(ray);
                expected.push_back(all.hits);
            }
            compareHits(layout, glyph, evaluator, inputs, expected, tally);
        }
        print("phantom", lmax, tally);
        EXPECT_GT(tally.rays, 1000);
    }
};

TEST_F(RealGlyphs, EveryFirstHitAndItsNormalAreFound) {
    for (const int lmax : {4, 8, 12}) {
        compareWithPhantom(lmax);
        if (const char* folder = std::getenv("RADIATA_DATA")) {
            compareWithFile(std::filesystem::path(folder) / "refs" / ("xa140_fod" + std::to_string(lmax) + "_geometry.npz"),
                            lmax);
        }
    }
}

}  // namespace
}  // namespace radiata
