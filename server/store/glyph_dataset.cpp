#include "store/glyph_dataset.h"

#include <algorithm>
#include <numeric>

#include "base/checked.h"
#include "build/glyph_instances.h"
#include "gpu/device.h"
#include "store/device_bounds.h"

namespace radiata::store {
namespace {

/// Coefficients of the slots, cut to the bands of a smaller layout; both kinds of layout order bands alike, so it is a prefix.
std::vector<float> gather(const model::ShImage& image, std::span<const std::uint32_t> slots, ShLayout layout) {
    const std::size_t stride = image.layout.count(), used = layout.count();
    std::vector<float> values(slots.size() * used);
    for (std::size_t i = 0; i < slots.size(); ++i) {
        std::copy_n(image.coefficients.begin() + static_cast<std::ptrdiff_t>(slots[i] * stride), used,
                    values.begin() + static_cast<std::ptrdiff_t>(i * used));
    }
    return values;
}

/// Stops at the first even band that is not 0, which nearly always is the first glyph's band 0.
bool hasOddBandsOnly(const model::ShImage& image) {
    if (!image.layout.full) return false;
    const std::size_t stride = image.layout.count();
    for (std::size_t glyph = 0; glyph * stride < image.coefficients.size(); ++glyph) {
        for (int l = 0; l <= image.layout.lmax; l += 2) {
            for (int m = -l; m <= l; ++m) {
                if (image.coefficients[glyph * stride + image.layout.index(l, m)] != 0) return false;
            }
        }
    }
    return true;
}

}  // namespace

GlyphDataset::GlyphDataset(gpu::Device& device, const std::string& id, model::ShImage image)
    : device_(device), image_(std::move(image)) {
    info_.id = id;
    info_.size = image_.size;
    info_.voxel_to_world = image_.voxel_to_world;
    info_.layout = image_.layout;
    info_.convention = image_.file_convention;
    info_.axes = image_.file_axes;
    info_.tensor_order = image_.tensor_order;
    info_.tensor_format = image_.tensor_format;
    info_.glyph_count = image_.voxels.size();
    info_.rejected_voxels = image_.rejected_voxels;
    datasetBounds(image_, info_.bounds_min, info_.bounds_max);
    odd_bands_only_ = hasOddBandsOnly(image_);
    const std::uint64_t bytes = checkedMultiply(image_.coefficients.size(), sizeof(float), "dataset '" + id + "'");
    coefficients_ = gpu::Buffer(device, std::max<std::uint64_t>(bytes, 4), gpu::Memory::kDevice, "coefficients of " + id);
    if (bytes > 0) gpu::upload(device, coefficients_, 0, std::as_bytes(std::span(image_.coefficients)));
    info_.gpu_bytes = coefficients_.sizeBytes();
    if (!image_.tensors.empty()) {
        tensors_ = gpu::Buffer(device, std::span(image_.tensors).size_bytes(), gpu::Memory::kDevice, "tensors of " + id);
        gpu::upload(device, tensors_, 0, std::as_bytes(std::span(image_.tensors)));
        info_.gpu_bytes += tensors_.sizeBytes();
    }
    // All bounds at once, for the amplitudes that scaling divides by: about 20 us a glyph at band 8 on two cores.
    std::vector<std::uint32_t> all(image_.voxels.size());
    std::iota(all.begin(), all.end(), 0U);
    std::vector<float> amplitudes;
    for (const GlyphBounds& glyph : bounds(all, image_.layout.lmax, false)) amplitudes.push_back(glyph.amplitude_max);
    if (!amplitudes.empty()) {
        info_.amplitude_max = *std::max_element(amplitudes.begin(), amplitudes.end());
        const auto at = amplitudes.begin() + static_cast<std::ptrdiff_t>((amplitudes.size() - 1) * 3 / 4);
        std::nth_element(amplitudes.begin(), at, amplitudes.end());
        info_.amplitude_typical = *at > 0 ? *at : info_.amplitude_max;
    }
}

std::vector<GlyphBounds> GlyphDataset::bounds(std::span<const std::uint32_t> slots, int lmax, bool negative_lobes) const {
    std::lock_guard lock(mutex_);
    Cache& cache = cache_[{lmax, negative_lobes}];
    cache.bounds.resize(image_.voxels.size());
    cache.known.resize(image_.voxels.size(), false);
    std::vector<std::uint32_t> missing;
    for (const std::uint32_t slot : slots) {
        if (!cache.known[slot]) missing.push_back(slot);
    }
    if (!missing.empty()) {
        const ShLayout layout{lmax, image_.layout.full};
        std::vector<GlyphBounds> computed(missing.size());
        if (device_.info().software) {
            BoundsEvaluator(layout).evaluate(gather(image_, missing, layout), negative_lobes, computed);
        } else {
            DeviceBounds evaluator(device_, layout);
            computed = evaluator.evaluate(coefficients_, image_.coefficients, image_.layout.count(), missing, negative_lobes);
        }
        for (std::size_t i = 0; i < missing.size(); ++i) {
            cache.bounds[missing[i]] = computed[i];
            cache.known[missing[i]] = true;
        }
    }
    std::vector<GlyphBounds> result(slots.size());
    for (std::size_t i = 0; i < slots.size(); ++i) result[i] = cache.bounds[slots[i]];
    return result;
}

}  // namespace radiata::store
