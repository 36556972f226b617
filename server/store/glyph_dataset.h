// One SH image on the device, with what planning and picking need of it on the CPU.
#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "build/bounds.h"
#include "gpu/buffer.h"
#include "model/dataset.h"
#include "model/sh_image.h"

namespace radiata::store {

/// Immutable but for a cache of bounds; thread-safe.
class GlyphDataset {
public:
    /// Uploads the coefficients. \throws Error(kResourceExhausted) naming the dataset and its bytes
    GlyphDataset(gpu::Device& device, const std::string& id, model::ShImage image);

    const model::DatasetInfo& info() const { return info_; }
    const model::ShImage& image() const { return image_; }
    /// float[glyphs][layout.count()], addressed by slot
    const gpu::Buffer& coefficients() const { return coefficients_; }

    /// float[glyphs][symmetricCount(tensor_order)], addressed by slot; empty if this is no tensor image
    const gpu::Buffer& tensors() const { return tensors_; }

    /// A full layout of which all even bands are 0, as tensors of odd order give.
    bool oddBandsOnly() const { return odd_bands_only_; }

    /// Certified bounds of some slots' glyphs with bands up to `lmax`, in units of amplitude; sampled by the device unless it
    /// is a CPU driver, on which our own threads are faster.
    std::vector<GlyphBounds> bounds(std::span<const std::uint32_t> slots, int lmax, bool negative_lobes) const;

private:
    struct Cache {
        std::vector<GlyphBounds> bounds;
        std::vector<bool> known;
    };
    gpu::Device& device_;
    model::ShImage image_;
    model::DatasetInfo info_;
    bool odd_bands_only_ = false;
    gpu::Buffer coefficients_, tensors_;
    mutable std::mutex mutex_;
    mutable std::map<std::pair<int, bool>, Cache> cache_;
};

}  // namespace radiata::store
