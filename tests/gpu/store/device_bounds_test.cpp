// Bounds sampled by the device: as those of the CPU up to rounding (1e-5 of the radius), and never smaller than a glyph, for
// both ways, on random and measured glyphs of bands 2 to 16. With RADIATA_FULL set: 2,000 glyphs of each kind against a million
// directions; else a share of that.
#include "store/device_bounds.h"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <numeric>
#include <random>
#include <string>

#include "base/error.h"
#include "build/phantom.h"
#include "gpu/device/fixture.h"
#include "io/sh_image.h"
#include "support/sphere_samples.h"

namespace radiata::store {
namespace {

bool fullRun() {
    const char* full = std::getenv("RADIATA_FULL");
    return full != nullptr && *full != '\0';
}

std::vector<float> uniformGlyphs(ShLayout layout, std::size_t glyphs, std::uint32_t seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> unit(-1, 1);
    std::vector<float> coefficients(glyphs * layout.count());
    for (float& c : coefficients) c = unit(random);
    return coefficients;
}

/// Glyphs of a brain with bands up to k: a measured one, where RADIATA_DATA has it, else the phantom.
std::vector<float> brainGlyphs(int k, std::size_t glyphs) {
    const ShLayout layout{k, false};
    const char* folder = std::getenv("RADIATA_DATA");
    model::ShImage image;
    if (folder != nullptr && *folder != '\0' && k <= 12) {
        const int file = k <= 4 ? 4 : k <= 8 ? 8 : 12;
        image = io::readShImage(std::filesystem::path(folder) / "sh" / ("xa140_fod" + std::to_string(file) + ".nii.gz"));
    } else {
        PhantomOptions options;
        options.slice_glyphs = std::max<std::size_t>(glyphs, 100);
        options.lmax = k;
        options.noise = 0.01;
        image = phantomShImage(options);
    }
    std::vector<float> coefficients;
    glyphs = std::min(glyphs, image.voxels.size());
    for (std::size_t g = 0; g < glyphs; ++g) {
        const std::size_t voxel = g * image.voxels.size() / glyphs;
        const float* first = image.coefficients.data() + voxel * image.layout.count();
        coefficients.insert(coefficients.end(), first, first + layout.count());
    }
    return coefficients;
}

class DeviceBoundsTest : public gpu::DeviceTest {
protected:
    std::vector<GlyphBounds> onDevice(ShLayout layout, const std::vector<float>& coefficients, bool negative_lobes) {
        gpu::Buffer buffer(device, coefficients.size() * 4, gpu::Memory::kDevice, "coefficients");
        gpu::upload(device, buffer, 0, std::as_bytes(std::span(coefficients)));
        std::vector<std::uint32_t> slots(coefficients.size() / layout.count());
        std::iota(slots.begin(), slots.end(), 0U);
        return DeviceBounds(device, layout).evaluate(buffer, coefficients, layout.count(), slots, negative_lobes);
    }

    static std::vector<GlyphBounds> onCpu(ShLayout layout, const std::vector<float>& coefficients, bool negative_lobes) {
        std::vector<GlyphBounds> bounds(coefficients.size() / layout.count());
        BoundsEvaluator(layout).evaluate(coefficients, negative_lobes, bounds);
        return bounds;
    }

    static void expectEqual(const GlyphBounds& a, const GlyphBounds& b) {
        const float slack = 1e-5F * std::max(b.radius, b.amplitude_max);
        EXPECT_NEAR(a.radius, b.radius, slack);
        EXPECT_NEAR(a.amplitude_max, b.amplitude_max, slack);
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_NEAR(a.min[axis], b.min[axis], slack);
            EXPECT_NEAR(a.max[axis], b.max[axis], slack);
        }
    }
};

TEST_F(DeviceBoundsTest, AgreeWithThoseOfTheCpu) {
    for (const ShLayout layout : {ShLayout{0, false}, ShLayout{2, false}, ShLayout{8, false}, ShLayout{16, false},
                                  ShLayout{1, true}, ShLayout{5, true}, ShLayout{16, true}}) {
        SCOPED_TRACE((layout.full ? "full " : "even ") + std::to_string(layout.lmax));
        const std::vector<float> coefficients = uniformGlyphs(layout, 7, 3);  // not a whole number of workgroups
        for (const bool negative_lobes : {false, true}) {
            const auto device_bounds = onDevice(layout, coefficients, negative_lobes);
            const auto cpu_bounds = onCpu(layout, coefficients, negative_lobes);
            for (std::size_t g = 0; g < cpu_bounds.size(); ++g) expectEqual(device_bounds[g], cpu_bounds[g]);
        }
    }
}

TEST_F(DeviceBoundsTest, TakeSlotsInAnyOrderAndFewerBands) {
    const ShLayout data{8, false}, layout{4, false};
    const std::vector<float> coefficients = uniformGlyphs(data, 20, 4);
    gpu::Buffer buffer(device, coefficients.size() * 4, gpu::Memory::kDevice, "coefficients");
    gpu::upload(device, buffer, 0, std::as_bytes(std::span(coefficients)));
    const std::vector<std::uint32_t> slots{17, 3, 3, 9, 0};
    const auto bounds = DeviceBounds(device, layout).evaluate(buffer, coefficients, data.count(), slots, true);
    ASSERT_EQ(bounds.size(), slots.size());
    for (std::size_t i = 0; i < slots.size(); ++i) {
        const auto first = coefficients.begin() + static_cast<std::ptrdiff_t>(slots[i] * data.count());
        const std::vector<float> one(first, first + static_cast<std::ptrdiff_t>(layout.count()));
        expectEqual(bounds[i], onCpu(layout, one, true)[0]);
    }
}

TEST_F(DeviceBoundsTest, HoldOverTheWholeRangeOfFloat) {
    const ShLayout layout{6, false};
    std::vector<float> coefficients = uniformGlyphs(layout, 6, 5);
    const int exponents[] = {-140, -120, -60, 60, 120, 127};
    for (std::size_t i = 0; i < coefficients.size(); ++i)
        coefficients[i] = std::ldexp(coefficients[i], exponents[i / layout.count()]);
    coefficients.resize(7 * layout.count(), 0.0F);  // and a glyph of zeros
    const auto device_bounds = onDevice(layout, coefficients, true), cpu_bounds = onCpu(layout, coefficients, true);
    for (std::size_t g = 0; g < cpu_bounds.size(); ++g) expectEqual(device_bounds[g], cpu_bounds[g]);
    EXPECT_EQ(device_bounds[6].radius, 0);
}

TEST_F(DeviceBoundsTest, RefuseWhatIsNotFinite) {
    std::vector<float> coefficients = uniformGlyphs({2, false}, 3, 6);
    coefficients[8] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_THROW(onDevice({2, false}, coefficients, true), Error);
}

class BoundsAndSamples : public DeviceBoundsTest {
protected:
    void expectNeverSmaller(int k) {
        const ShLayout layout{k, false};
        const std::size_t glyphs = fullRun() ? 2000 : 24, samples = fullRun() ? 1'000'000 : 32'768;
        for (const bool real : {false, true}) {
            SCOPED_TRACE(real ? "of a brain" : "random");
            const std::vector<float> coefficients =
                real ? brainGlyphs(k, glyphs) : uniformGlyphs(layout, glyphs, static_cast<std::uint32_t>(k));
            const auto truth = testing::sampleExtents(layout, coefficients, samples);
            EXPECT_GE(truth.size(), 24U);
            for (const bool negative_lobes : {false, true}) {
                expectHold(onDevice(layout, coefficients, negative_lobes), truth, negative_lobes);
                expectHold(onCpu(layout, coefficients, negative_lobes), truth, negative_lobes);
            }
        }
    }

    static void expectHold(const std::vector<GlyphBounds>& bounds, const std::vector<testing::SampledExtents>& truth,
                           bool both) {
        for (std::size_t g = 0; g < truth.size(); ++g) {
            const auto& extents = both ? truth[g].both : truth[g].positive;
            EXPECT_GE(bounds[g].radius, extents[0]);
            for (int axis = 0; axis < 3; ++axis) {
                EXPECT_GE(bounds[g].max[axis], extents[static_cast<std::size_t>(1 + axis)]);
                EXPECT_GE(-bounds[g].min[axis], extents[static_cast<std::size_t>(4 + axis)]);
            }
        }
    }
};

TEST_F(BoundsAndSamples, NeverSmallerUpToBand8) {
    for (int k = 2; k <= 8; k += 2) expectNeverSmaller(k);
}
TEST_F(BoundsAndSamples, NeverSmallerAtBand10) { expectNeverSmaller(10); }
TEST_F(BoundsAndSamples, NeverSmallerAtBand12) { expectNeverSmaller(12); }
TEST_F(BoundsAndSamples, NeverSmallerAtBand14) { expectNeverSmaller(14); }
TEST_F(BoundsAndSamples, NeverSmallerAtBand16) { expectNeverSmaller(16); }

}  // namespace
}  // namespace radiata::store
