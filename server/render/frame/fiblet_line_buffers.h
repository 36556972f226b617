// What a view keeps for pipelines that give lines of fibres to the device's rasteriser: images that are drawn into, and decoded
// fiblets on their way there.
#pragma once

#include <cstdint>

#include "gpu/buffer.h"
#include "gpu/raster_target.h"
#include "model/frame.h"
#include "shaders/shared/fiblet_draw.glsl"

namespace radiata::render {

/// While the view's frames are drawn so.
struct FibletLineBuffers {
    gpu::RasterTarget images;
    gpu::Buffer words, depth;  ///< of the images
    gpu::Buffer slots;         ///< shader::FibletSlot[kSlots]; pull only
    gpu::Buffer command;       ///< VkDrawIndirectCommand; pull only

    static constexpr std::uint32_t kSlots = 16'384;
    /// Whose lines have room there too, as shader::FibletListedLine.
    static constexpr std::uint32_t kListedFiblets =
        kSlots * sizeof(shader::FibletSlot) / (shader::FIBLET_SEGMENTS * sizeof(shader::FibletListedLine));
    /// Makes room for a picture; keeps what fits. \throws Error(kResourceExhausted)
    void prepare(gpu::Device& device, std::uint32_t width, std::uint32_t height, model::FibletPipeline pipeline);
};

}  // namespace radiata::render
