// The reference against an independent brute-force implementation on glyphs of a measured brain (folder RADIATA_DATA), and in
// any case against glyphs written in MRtrix3's convention by the standard library.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <numbers>

#include <gtest/gtest.h>

#include "math/sh_convention.h"
#include "random_glyphs.h"
#include "reference/glyph_bounds.h"
#include "reference/glyph_hits.h"
#include "support/npz.h"

namespace radiata::reference {
namespace {

ShFunction fromMrtrix(ShLayout layout, std::vector<double> coefficients) {
    convertSh(std::span<double>(coefficients), layout, ShConvention::kTournier07, ShConvention::kDescoteaux07);
    return {layout, std::span<const double>(coefficients)};
}

glm::dvec3 vectorAt(const testing::NpyArray& array, std::size_t i) {
    return {array.values[3 * i], array.values[3 * i + 1], array.values[3 * i + 2]};
}

/// Every hit, sign and normal, and every bound, of one file.
void compareWithFile(const std::filesystem::path& path, int lmax) {
    const testing::NpzFile file(path);
    const ShLayout layout{lmax, false};
    const auto coefficients = file.array("coef_mrtrix"), origins = file.array("ray_o"), directions = file.array("ray_d"),
               times = file.array("hit_t"), signs = file.array("hit_sign"), normals = file.array("hit_normal"),
               graze = file.array("graze"), boxes = file.array("aabb_pos"), both_boxes = file.array("aabb_abs"),
               radii = file.array("radius_max");
    const std::size_t glyphs = times.shape.at(0), rays = times.shape.at(1), slots = times.shape.at(2);
    int compared = 0, hits = 0, more = 0;
    for (std::size_t g = 0; g < glyphs; ++g) {
        const auto first = coefficients.values.begin() + std::ptrdiff_t(g * layout.count());
        const ShFunction f = fromMrtrix(layout, {first, first + std::ptrdiff_t(layout.count())});
        const double radius = radii.values[g];
        const GlyphBounds positive = glyphBounds(f, false), both = glyphBounds(f, true);
        EXPECT_GE(both.radius, radius * (1 - 1e-7));
        EXPECT_LE(both.radius, radius * (1 + 1e-3));  // the file's radius is the largest of samples
        for (int axis = 0; axis < 3; ++axis) {
            const std::size_t low = g * 6 + std::size_t(axis);
            EXPECT_NEAR(positive.min[axis], boxes.values[low], 1e-7 * radius);
            EXPECT_NEAR(positive.max[axis], boxes.values[low + 3], 1e-7 * radius);
            EXPECT_NEAR(both.min[axis], both_boxes.values[low], 1e-7 * radius);
            EXPECT_NEAR(both.max[axis], both_boxes.values[low + 3], 1e-7 * radius);
        }
        for (std::size_t r = g * rays; r < (g + 1) * rays; ++r) {
            if (graze.values[r] != 0) continue;
            const GlyphHits found = glyphHits(f, vectorAt(origins, r), vectorAt(directions, r), true);
            if (found.grazing) continue;
            ++compared;
            std::size_t expected = 0;
            while (expected < slots && !std::isnan(times.values[r * slots + expected])) ++expected;
            // The file was made by sampling along the ray, which loses pairs of hits that lie close together at the centre.
            ASSERT_GE(found.hits.size(), expected) << "glyph " << g << " ray " << r;
            if (found.hits.size() > expected) {
                ++more;
                const glm::dvec3 o = vectorAt(origins, r), d = vectorAt(directions, r);
                EXPECT_LT(glm::length(o - glm::dot(o, d) * d), 0.05 * radius) << "glyph " << g << " ray " << r;
            }
            for (std::size_t h = 0; h < expected; ++h, ++hits) {
                const std::size_t slot = r * slots + h;
                const GlyphHit& nearest = *std::min_element(found.hits.begin(), found.hits.end(),
                                                            [t = times.values[slot]](const GlyphHit& a, const GlyphHit& b) {
                                                                return std::abs(a.t - t) < std::abs(b.t - t);
                                                            });
                EXPECT_NEAR(nearest.t, times.values[slot], 1e-7 * radius);
                EXPECT_EQ(nearest.amplitude > 0, signs.values[slot] > 0);
                EXPECT_LT(glm::length(nearest.normal - vectorAt(normals, slot)), 1e-4);
                if (h == 0) {
                    EXPECT_EQ(&nearest, &found.hits.front());
                }
            }
        }
    }
    std::printf("%s: %d rays, %d hits, %d rays with more hits than the file has\n", path.filename().c_str(), compared, hits,
                more);
    EXPECT_GT(compared, int(glyphs * rays) * 9 / 10);
}

TEST(MeasuredGlyphs, AgreeWithReferenceValues) {
    std::mt19937_64 random(13);
    const ShLayout layout{8, false};
    const std::vector<double> mrtrix = test::randomCoefficients(random, layout);
    const ShFunction f = fromMrtrix(layout, mrtrix);
    for (int i = 0; i < 100; ++i) {
        const glm::dvec3 p = test::unitVector(random);
        const double theta = std::acos(p.z), angle = std::atan2(p.y, p.x);
        double expected = 0;
        for (int l = 0; l <= 8; l += 2) {
            for (int m = -l; m <= l; ++m) {
                const double azimuth = m == 0  ? 1
                                       : m < 0 ? std::numbers::sqrt2 * std::sin(-m * angle)
                                               : std::numbers::sqrt2 * std::cos(m * angle);
                expected += mrtrix[layout.index(l, m)] * azimuth * std::sph_legendre(unsigned(l), unsigned(std::abs(m)), theta);
            }
        }
        EXPECT_NEAR(f(p), expected, 1e-12);
    }
    if (const char* folder = std::getenv("RADIATA_DATA")) {
        for (const int lmax : {4, 8, 12}) {
            compareWithFile(std::filesystem::path(folder) / "refs" / ("xa140_fod" + std::to_string(lmax) + "_geometry.npz"),
                            lmax);
        }
    }
}

}  // namespace
}  // namespace radiata::reference
