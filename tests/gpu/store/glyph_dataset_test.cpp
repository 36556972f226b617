// One dataset on the device: its bytes are there, its amplitudes and bounds are those of its glyphs, with fewer bands too.
#include "store/glyph_dataset.h"

#include <cmath>
#include <numbers>
#include <random>
#include <thread>

#include "gpu/device/fixture.h"

namespace radiata::store {
namespace {

using DatasetTest = gpu::DeviceTest;

const double kY00 = 1 / std::sqrt(4 * std::numbers::pi);

/// One glyph per voxel of a row, random coefficients.
model::ShImage row(int count, ShLayout layout) {
    model::ShImage image;
    image.size = {count, 1, 1};
    image.layout = layout;
    std::mt19937 random(9);
    std::uniform_real_distribution<float> value(-1, 1);
    for (int i = 0; i < count; ++i) image.voxels.push_back({i, 0, 0});
    image.coefficients.resize(static_cast<std::size_t>(count) * layout.count());
    for (float& coefficient : image.coefficients) coefficient = value(random);
    return image;
}

TEST_F(DatasetTest, CoefficientsLieOnTheDeviceAsTheyWere) {
    const model::ShImage image = row(100, {4, false});
    const GlyphDataset dataset(device, "bytes", image);
    EXPECT_EQ(dataset.info().gpu_bytes, 100U * 15 * 4);
    EXPECT_EQ(dataset.coefficients().sizeBytes(), 100U * 15 * 4);
    std::vector<float> back(image.coefficients.size());
    gpu::download(device, dataset.coefficients(), 0, std::as_writable_bytes(std::span(back)));
    EXPECT_EQ(back, image.coefficients);
    EXPECT_EQ(dataset.info().glyph_count, 100U);
    EXPECT_EQ(dataset.info().bounds_min, glm::dvec3(-0.5));
    EXPECT_EQ(dataset.info().bounds_max, glm::dvec3(99.5, 0.5, 0.5));
}

TEST_F(DatasetTest, AmplitudesAreTheLargestAndTheThreeQuarterOne) {
    // Spheres of radius 1, 2, ... 9 and negative ones in between: amplitudes count without sign.
    model::ShImage image = row(9, {0, false});
    for (int i = 0; i < 9; ++i) {
        image.coefficients[static_cast<std::size_t>(i)] = static_cast<float>((i % 2 ? -1 : 1) * (9 - i) / kY00);
    }
    const GlyphDataset dataset(device, "spheres", image);
    EXPECT_NEAR(dataset.info().amplitude_max, 9, 1e-5);
    EXPECT_NEAR(dataset.info().amplitude_typical, 7, 1e-5) << "six of the nine stay below it";
}

TEST_F(DatasetTest, ADatasetWithoutGlyphsIsSound) {
    model::ShImage image = row(0, {8, false});
    image.size = {2, 2, 2};
    const GlyphDataset dataset(device, "empty", image);
    EXPECT_EQ(dataset.info().glyph_count, 0U);
    EXPECT_EQ(dataset.info().amplitude_max, 0);
    EXPECT_TRUE(dataset.bounds({}, 8, false).empty());
}

TEST_F(DatasetTest, BoundsOfFewerBandsAreThoseOfTheCutGlyphs) {
    for (const bool full : {false, true}) {
        const ShLayout layout{6, full};
        const model::ShImage image = row(40, layout);
        const GlyphDataset dataset(device, "bounds", image);
        for (const int lmax : {6, 4, 2, 0}) {
            const ShLayout cut{lmax, full};
            const std::vector<std::uint32_t> slots = {39, 3, 17, 3};
            std::vector<float> coefficients;
            for (const std::uint32_t slot : slots) {
                const auto begin = image.coefficients.begin() + static_cast<std::ptrdiff_t>(slot * layout.count());
                coefficients.insert(coefficients.end(), begin, begin + static_cast<std::ptrdiff_t>(cut.count()));
            }
            for (const bool negative_lobes : {false, true}) {
                std::vector<GlyphBounds> expected(slots.size());
                BoundsEvaluator(cut).evaluate(coefficients, negative_lobes, expected);
                // Twice: the second answer comes from the cache.
                for (int time = 0; time < 2; ++time) {
                    const std::vector<GlyphBounds> bounds = dataset.bounds(slots, lmax, negative_lobes);
                    ASSERT_EQ(bounds.size(), slots.size());
                    for (std::size_t i = 0; i < slots.size(); ++i) {
                        EXPECT_EQ(bounds[i].min, expected[i].min) << lmax;
                        EXPECT_EQ(bounds[i].max, expected[i].max) << lmax;
                        EXPECT_EQ(bounds[i].radius, expected[i].radius) << lmax;
                        EXPECT_EQ(bounds[i].amplitude_max, expected[i].amplitude_max) << lmax;
                    }
                }
            }
        }
    }
}

TEST_F(DatasetTest, BoundsMayBeAskedForByManyThreads) {
    const model::ShImage image = row(300, {4, false});
    const GlyphDataset dataset(device, "threads", image);
    std::vector<std::uint32_t> all(300);
    for (std::uint32_t i = 0; i < 300; ++i) all[i] = i;
    std::vector<std::vector<GlyphBounds>> results(4);
    {
        std::vector<std::jthread> threads;
        for (std::size_t t = 0; t < 4; ++t) {
            threads.emplace_back([&, t] { results[t] = dataset.bounds(std::span(all).subspan(50 * t, 100), 2, true); });
        }
    }
    const std::vector<GlyphBounds> expected = dataset.bounds(all, 2, true);
    for (std::size_t t = 0; t < 4; ++t) {
        ASSERT_EQ(results[t].size(), 100U);
        for (std::size_t i = 0; i < 100; ++i) EXPECT_EQ(results[t][i].radius, expected[50 * t + i].radius);
    }
}

}  // namespace
}  // namespace radiata::store
