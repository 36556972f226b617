// What one view keeps of one layer of fiblets: words of pixels, who was seen last, lists of what is drawn.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gpu/buffer.h"
#include "render/fiblet/fiblet_scene.h"
#include "shaders/shared/fiblet_draw.glsl"

namespace radiata::render {

struct FibletBuffers {
    gpu::Buffer params;                        ///< shader::FibletLayerParams, then shader::FibletCounts
    gpu::Buffer words;                         ///< uint64[pixels]
    gpu::Buffer tangents;                      ///< uint64[pixels]
    gpu::Buffer visible;                       ///< one bit per fiblet
    gpu::Buffer list;                          ///< uint[max(fiblets, pixels)]
    gpu::Buffer page_order;                    ///< uint[pages]
    gpu::Buffer peeled, fragments;             ///< of a transparent layer: uint64[pixels]; uint[pixels] while moving
    gpu::Buffer pyramid;                       ///< uint[]
    std::vector<std::uint32_t> level_offsets;  ///< of the pyramid, in words, from level 1 on
    std::uint64_t scene_serial = 0;            ///< whose fiblets `visible` is about; 0: nobody's
    bool knows_visible = false;
    std::uint64_t drawn = 0;  ///< fiblets of the latest sample

    static constexpr std::uint64_t kCountsOffset = 512;
    shader::FibletLayerParams& layer() const { return *reinterpret_cast<shader::FibletLayerParams*>(params.mapped().data()); }
    shader::FibletCounts& counts() const {
        return *reinterpret_cast<shader::FibletCounts*>(params.mapped().data() + kCountsOffset);
    }
    std::uint64_t layerAddress() const { return params.address(); }

    /// Buffers for a window of a picture. \param culled  lists and pyramid too \throws Error(kResourceExhausted)
    void prepare(gpu::Device& device, const FibletScene& scene, const glm::ivec2& size, bool culled);
    /// What a transparent layer takes besides, after fill().
    void preparePeels(gpu::Device& device, std::uint64_t pixels, bool counted);
    /// Everything that drawing reads. \param view  of this sample
    void fill(const FibletScene& scene, const shader::FibletView& view, std::span<const shader::FibletCut> cuts,
              std::uint64_t states, std::uint32_t layer_index);

private:
    glm::ivec2 size_{0};
};

}  // namespace radiata::render
