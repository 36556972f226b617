// What one view keeps of one layer of fiblets: words of pixels, who was seen last, lists of what is drawn.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "gpu/buffer.h"
#include "render/fiblet/fiblet_scene.h"
#include "shaders/shared/fiblet_draw.glsl"

namespace radiata::render {

class FibletCoverage;

struct FibletBuffers {
    FibletBuffers();
    ~FibletBuffers();
    gpu::Buffer params;                        ///< shader::FibletLayerParams, then shader::FibletCounts
    gpu::Buffer words;                         ///< uint64[pixels]
    gpu::Buffer tangents;                      ///< uint64[pixels]
    gpu::Buffer visible;                       ///< one bit per fiblet
    gpu::Buffer list;                          ///< uint[max(fiblets, pixels)]
    gpu::Buffer page_order;                    ///< uint[pages]
    gpu::Buffer found_pages;                   ///< uint[pages]: in which fiblets can be seen
    gpu::Buffer found_page_numbers;            ///< the same, read back, for a scene that is not all on the device
    gpu::Buffer shown_pages;                   ///< uint[pages]: what is drawn of them
    gpu::Buffer peeled, fragments;             ///< of a transparent layer: uint64[pixels]; uint[pixels] while moving
    gpu::Buffer chain, limits;                 ///< of one: shader::ChainSlot[slots][pixels]; uint[pixels]
    gpu::Buffer cut_front, cut_back;           ///< uint[pixels]; only where a mesh cuts by its depths
    gpu::Buffer pyramid;                       ///< uint[]
    gpu::Buffer next;                          ///< uint[fiblets]: that goes on along the fibre; only where it is looked at
    std::vector<std::uint32_t> level_offsets;  ///< of the pyramid, in words, from level 1 on
    std::uint64_t scene_serial = 0;            ///< whose fiblets `visible` is about; 0: nobody's
    bool knows_visible = false;
    std::unique_ptr<FibletCoverage> coverage;  ///< only for that scheme of culling
    std::uint64_t drawn = 0;                   ///< fiblets of the latest sample
    /// Of the latest sample, for a scene that is not all on the device: pages that can be seen, those of them that have no
    /// room, and those that are still to come.
    std::uint64_t pages_wanted = 0, pages_left_out = 0, pages_missing = 0;
    std::vector<std::uint32_t> near_first;  ///< page_order, for such a scene

    static constexpr std::uint64_t kCountsOffset = 512;
    shader::FibletLayerParams& layer() const { return *reinterpret_cast<shader::FibletLayerParams*>(params.mapped().data()); }
    shader::FibletCounts& counts() const {
        return *reinterpret_cast<shader::FibletCounts*>(params.mapped().data() + kCountsOffset);
    }
    std::uint64_t layerAddress() const { return params.address(); }

    /// Buffers for a window of a picture. \param culled  lists and pyramid too \param ends  where fiblets end too
    /// \throws Error(kResourceExhausted)
    void prepare(gpu::Device& device, const FibletScene& scene, const glm::ivec2& size, bool culled, bool ends);
    /// What a transparent layer takes besides, after fill(). \param slots  segments that each pixel keeps
    void preparePeels(gpu::Device& device, std::uint64_t pixels, std::uint32_t slots, bool counted);
    /// Everything that drawing reads. \param view  of this sample
    void fill(const FibletScene& scene, const shader::FibletView& view, std::span<const shader::FibletCut> cuts,
              std::uint64_t states, std::uint32_t layer_index);
    /// Pages nearest first by the layer's view, into page_order. \return  how many
    std::uint32_t orderPages(const FibletScene& scene);

private:
    glm::ivec2 size_{0};
    std::uint64_t next_serial_ = 0;  ///< whose fiblets `next` is about
};

}  // namespace radiata::render
