// The test brain: deterministic, of the size asked for, with bundles where their names say, lobes along their courses and
// true crossings.
#include "build/phantom.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "base/error.h"
#include "build/phantom_lobe.h"
#include "build/phantom_tissue.h"
#include "math/sh_evaluate.h"
#include "unit/build/sphere_function.h"

namespace radiata {
namespace {

PhantomOptions small(int size = 40, int lmax = 8) {
    PhantomOptions options;
    options.size = size;
    options.lmax = lmax;
    return options;
}

/// Directions of the local maxima above a third of the largest, one of each antipodal pair.
std::vector<glm::dvec3> peaks(ShLayout layout, std::span<const float> coefficients) {
    const auto f = [&](const glm::dvec3& d) { return evaluateSh(layout, coefficients, d); };
    std::vector<std::pair<double, glm::dvec3>> found;
    for (const glm::dvec3& start : testing::fibonacciDirections(50)) {
        glm::dvec3 peak;
        const double height = testing::climb(f, start, 0.1, &peak);
        const bool known = std::any_of(found.begin(), found.end(),
                                       [&](const auto& other) { return std::abs(glm::dot(other.second, peak)) > 0.99; });
        if (!known) found.emplace_back(height, peak);
    }
    double highest = 0;
    for (const auto& [height, peak] : found) highest = std::max(highest, height);
    std::vector<glm::dvec3> result;
    for (const auto& [height, peak] : found) {
        if (height > highest / 3) result.push_back(peak);
    }
    return result;
}

std::span<const float> glyph(const model::ShImage& image, std::size_t v) {
    return std::span(image.coefficients).subspan(v * image.layout.count(), image.layout.count());
}

TEST(Phantom, SameSeedSameBytesOtherSeedOtherBytes) {
    PhantomOptions options = small(24);
    options.noise = 0.02;
    const model::ShImage first = phantomShImage(options), second = phantomShImage(options);
    EXPECT_EQ(first.voxels, second.voxels);
    EXPECT_EQ(first.coefficients, second.coefficients);
    options.seed = 2;
    EXPECT_NE(phantomShImage(options).coefficients, first.coefficients);
}

TEST(Phantom, NoiseDependsOnThePlaceAndHasTheAskedSpread) {
    PhantomOptions options = small(24);
    const model::ShImage clean = phantomShImage(options);
    options.noise = 0.05;
    const model::ShImage noisy = phantomShImage(options);
    ASSERT_EQ(clean.coefficients.size(), noisy.coefficients.size());
    double sum = 0, squares = 0;
    const double count = static_cast<double>(clean.coefficients.size());
    for (std::size_t i = 0; i < clean.coefficients.size(); ++i) {
        const double difference = static_cast<double>(noisy.coefficients[i]) - clean.coefficients[i];
        sum += difference;
        squares += difference * difference;
    }
    EXPECT_GT(count, 50000);
    EXPECT_NEAR(sum / count, 0, 0.001);
    EXPECT_NEAR(std::sqrt(squares / count), 0.05, 0.001);
}

TEST(Phantom, HasTheSizeAskedFor) {
    for (int size : {1, 2, 7, 33}) {
        const PhantomGrid grid = Phantom(small(size)).grid();
        EXPECT_EQ(std::max({grid.size.x, grid.size.y, grid.size.z}), size);
    }
    EXPECT_EQ(phantomShImage(small(1)).voxels.size(), 1U);
    PhantomOptions options;
    options.voxel_mm = 10;
    const Phantom phantom(options);
    EXPECT_EQ(phantom.grid().voxel_to_world[1][1], 10);
    const model::ShImage image = phantom.shImage();
    EXPECT_EQ(image.size, phantom.grid().size);
    EXPECT_EQ(image.coefficients.size(), image.voxels.size() * 45);
    EXPECT_TRUE(std::is_sorted(image.voxels.begin(), image.voxels.end(), [](const glm::ivec3& a, const glm::ivec3& b) {
        return std::array{a.z, a.y, a.x} < std::array{b.z, b.y, b.x};
    }));
}

TEST(Phantom, DenseSliceHasAtLeastTheGlyphsAskedForAndFewMore) {
    for (std::uint64_t glyphs : {1ULL, 500ULL, 20000ULL}) {
        PhantomOptions options = small(1, 2);
        options.slice_glyphs = glyphs;
        const model::ShImage image = phantomShImage(options);
        EXPECT_EQ(image.size.z, 1);
        EXPECT_GE(image.voxels.size(), glyphs);
        if (glyphs > 1000) {
            EXPECT_LE(image.voxels.size(), glyphs * 21 / 20);
        }
    }
}

TEST(Phantom, EveryEvenBandLimitIsFiniteAndNotZero) {
    for (int lmax = 0; lmax <= 16; lmax += 2) {
        const model::ShImage image = phantomShImage(small(12, lmax));
        EXPECT_EQ(image.layout, (ShLayout{lmax, false}));
        EXPECT_GT(image.voxels.size(), 100U);
        for (std::size_t v = 0; v < image.voxels.size(); ++v) {
            const auto c = glyph(image, v);
            EXPECT_TRUE(std::all_of(c.begin(), c.end(), [](float value) { return std::isfinite(value); }));
            EXPECT_GT(c[0], 0);
        }
    }
}

TEST(Phantom, LobeIsAlongItsAxisWithLittleRinging) {
    const glm::dvec3 axis = glm::normalize(glm::dvec3(0.3, -0.5, 0.8));
    for (int lmax = 2; lmax <= 16; lmax += 2) {
        const phantom::Lobe lobe({lmax, false});
        std::vector<double> c(lobe.layout().count(), 0.0), basis(c.size());
        lobe.add(axis, 1, c, basis);
        const double peak = evaluateSh(lobe.layout(), std::span<const double>(c), axis);
        for (const glm::dvec3& d : testing::fibonacciDirections(500)) {
            const double value = evaluateSh(lobe.layout(), std::span<const double>(c), d);
            EXPECT_LE(value, peak);
            EXPECT_GE(value, -0.03 * peak) << "lmax " << lmax;
        }
    }
}

TEST(Phantom, PeaksOfPureVoxelsPointAlongTheBundleWithinTwoDegrees) {
    const Phantom phantom(small(60));
    const model::ShImage image = phantom.shImage();
    std::map<int, int> checked;
    for (std::size_t v = 0; v < image.voxels.size(); ++v) {
        const glm::dvec3 p = phantom.grid().voxelCentre(image.voxels[v]);
        const phantom::FieldSample fibres = phantom.field().sample(p);
        if (fibres.count != 1 || fibres.bundles[0].fraction < 0.7 || checked[fibres.bundles[0].id] >= 12) continue;
        if (phantom::tissueAt(p, 1).tissue == phantom::Tissue::kFluid) continue;
        const std::vector<glm::dvec3> found = peaks(image.layout, glyph(image, v));
        ASSERT_EQ(found.size(), 1U);
        EXPECT_GT(std::abs(glm::dot(found[0], fibres.bundles[0].tangent)), std::cos(2 * 3.14159265 / 180));
        ++checked[fibres.bundles[0].id];
    }
    EXPECT_EQ(checked.size(), 7U);
    for (const auto& [id, count] : checked) EXPECT_GE(count, 5) << "bundle " << id;
}

TEST(Phantom, ThreeBundlesCrossInBothHemispheres) {
    for (std::uint64_t seed : {1ULL, 2ULL, 3ULL}) {
        PhantomOptions options = small(90);
        options.seed = seed;
        const Phantom phantom(options);
        const model::ShImage image = phantom.shImage();
        std::map<bool, int> crossings;
        for (std::size_t v = 0; v < image.voxels.size(); ++v) {
            const glm::dvec3 p = phantom.grid().voxelCentre(image.voxels[v]);
            const phantom::FieldSample fibres = phantom.field().sample(p);
            if (fibres.count != 3 || std::abs(p.z - 32) > 6) continue;
            const auto& b = fibres.bundles;
            if (b[0].fraction < 0.2 || b[1].fraction < 0.2 || b[2].fraction < 0.2 || crossings[p.x < 0] >= 5) continue;
            const bool left = p.x < 0;
            EXPECT_EQ(b[0].id, phantom::kCorpusCallosum);
            EXPECT_EQ(b[1].id, left ? phantom::kCorticospinalLeft : phantom::kCorticospinalRight);
            EXPECT_EQ(b[2].id, left ? phantom::kArcuateLeft : phantom::kArcuateRight);
            const std::vector<glm::dvec3> found = peaks(image.layout, glyph(image, v));
            EXPECT_GE(found.size(), 2U);
            EXPECT_LE(found.size(), 3U);
            ++crossings[left];
        }
        EXPECT_GE(crossings[true], 3) << "seed " << seed;
        EXPECT_GE(crossings[false], 3) << "seed " << seed;
    }
}

TEST(Phantom, BundlesAreOnTheSideOfTheirName) {
    const Phantom phantom(small(60));
    const std::vector<std::uint8_t> labels = phantom.labels();
    const PhantomGrid& grid = phantom.grid();
    std::map<int, std::size_t> voxels;
    std::size_t index = 0;
    for (int k = 0; k < grid.size.z; ++k) {
        for (int j = 0; j < grid.size.y; ++j) {
            for (int i = 0; i < grid.size.x; ++i, ++index) {
                const int id = labels[index];
                const double x = grid.voxelCentre({i, j, k}).x;
                if (id >= phantom::kCorticospinalLeft) {
                    EXPECT_EQ(x < 0, id % 2 == 0) << "bundle " << id << " at x " << x;  // left ones have even ids
                }
                ++voxels[id];
            }
        }
    }
    EXPECT_EQ(voxels.size(), 8U);  // seven bundles and none
    std::set<std::string> names;
    for (const phantom::Bundle& bundle : phantom.field().bundles()) {
        EXPECT_GT(voxels[bundle.id], 40U) << bundle.name;
        names.insert(bundle.name);
        EXPECT_EQ(bundle.name.ends_with("_left"), bundle.id != 1 && bundle.id % 2 == 0);
    }
    EXPECT_EQ(names.size(), 7U);
    for (int left : {2, 4, 6}) {
        EXPECT_NEAR(static_cast<double>(voxels[left]) / static_cast<double>(voxels[left + 1]), 1, 0.05);
    }
}

TEST(Phantom, RefusesWhatItCannotMake) {
    const auto message = [](auto change) {
        PhantomOptions options;
        change(options);
        try {
            Phantom phantom(options);
        } catch (const Error& error) {
            return std::string(error.what());
        }
        return std::string("accepted");
    };
    EXPECT_NE(message([](PhantomOptions& o) { o.size = 0; }).find("size is 0"), std::string::npos);
    EXPECT_NE(message([](PhantomOptions& o) { o.size = 400; }).find("MiB"), std::string::npos);
    EXPECT_NE(message([](PhantomOptions& o) { o.size = 5000; }).find("size is 5000"), std::string::npos);
    EXPECT_NE(message([](PhantomOptions& o) { o.lmax = 3; }).find("lmax is 3"), std::string::npos);
    EXPECT_NE(message([](PhantomOptions& o) { o.lmax = 18; }).find("lmax is 18"), std::string::npos);
    EXPECT_NE(message([](PhantomOptions& o) { o.noise = -1; }).find("noise is -1"), std::string::npos);
    EXPECT_NE(message([](PhantomOptions& o) { o.noise = std::nan(""); }).find("noise is"), std::string::npos);
    EXPECT_NE(message([](PhantomOptions& o) { o.voxel_mm = 0.0; }).find("voxel is 0"), std::string::npos);
    EXPECT_NE(message([](PhantomOptions& o) { o.slice_glyphs = 2'000'000; }).find("slice is 2000000"), std::string::npos);
}

}  // namespace
}  // namespace radiata
