// Device buffers of one view. See render/frame/renderer.h for who may use them.
#pragma once

#include <memory>
#include <vector>

#include "gpu/buffer.h"
#include "render/frame/renderer.h"
#include "shaders/shared/frame.glsl"
#include "shaders/shared/glyph.glsl"
#include "shaders/shared/layer_look.glsl"
#include "shaders/shared/uncertainty.glsl"

namespace radiata::render {

struct Counters {
    std::uint32_t hit_pixels = 0;
    std::uint32_t capped_rays = 0;
};

/// Tile lists and pole-frame table of one layer, for the camera of the latest first sample.
struct LayerBuffers {
    gpu::Buffer tile_ranges, tile_entries, table;
    gpu::Buffer sun_ranges, sun_entries, sun_table;  ///< the same along the light's direction
};

/// Of layers' second glyphs; all empty where no layer has them.
struct UncertaintyBuffers {
    gpu::Buffer params;  ///< shader::UncertaintyParams[layers]
    gpu::Buffer media;   ///< shader::Medium[pixels], of the latest sample
    std::vector<LayerBuffers> layers;
};
struct RasterBuffers;
struct FibletBuffers;
struct FibletLineBuffers;

struct Target::Impl {
    Impl();
    ~Impl();
    int width = 0, height = 0;
    int samples = 0;               ///< in the light buffer
    std::uint64_t hit_pixels = 0;  ///< of the first of them
    model::FrameRequest request;   ///< that the samples belong to
    gpu::Buffer surface;           ///< shader::Surface[pixels]
    gpu::Buffer light;             ///< vec3[pixels], sum over samples
    gpu::Buffer picture;           ///< rgba8[pixels], read back
    gpu::Buffer surface_readback;  ///< only once an output was wanted
    gpu::Buffer shadow_bits;  ///< uint[pixels], rays towards the light that glyphs block; only once a scene asked for shadows
    gpu::Buffer occlusion_bits;  ///< the same for rays of ambient occlusion
    gpu::Buffer params;          ///< FrameParams, GlyphLayerParams[], LayerLook[], Counters
    std::vector<LayerBuffers> layers;
    UncertaintyBuffers uncertainty;
    gpu::Buffer isosurfaces;   ///< shader::IsosurfaceParams[layers]; only once a scene has an isosurface
    gpu::Buffer veil;          ///< vec4[pixels], of the latest sample; only once a scene has a transparent layer
    gpu::Buffer peel_surface;  ///< shader::Surface[pixels]; only once a scene had layers to peel, as these:
    gpu::Buffer peel_params, peel_crossings, peel_rest;  ///< shaders/shared/peel.glsl
    std::vector<gpu::Buffer> peel_glyphs;                ///< shader::Surface[pixels] of layers of transparent glyphs
    gpu::Buffer fxaa_source;                             ///< rgba8[pixels]; only once a picture was smoothed
    bool approximate = false;           ///< the one sample has transparent layers as they are drawn while moving
    gpu::Buffer global_light;           ///< vec3[pixels], of the latest sample; only once a scene has global light
    gpu::Buffer surface_looks;          ///< shader::SurfaceLook[layers]; only once an isosurface has one
    gpu::Buffer paths;                  ///< shader::PixelPaths[pixels], of the latest sample; only once pixels were path-traced
    bool pages_missing = false;         ///< the latest sample waits for pages of fibres
    std::uint64_t pages_serial = 0;     ///< of the scenes of fibres when it was drawn
    std::uint32_t path_count = 0;       ///< paths of each replicate in them
    double path_seconds = 0;            ///< spent on paths of the picture
    std::uint64_t surface_number = 0;   ///< of the first sample in the surface buffer: views have their own
    std::uint64_t request_surface = 0;  ///< that which `request` was drawn into
    bool in_slices = false;             ///< its one sample's light is being worked on, slice by slice
    bool settled = false;               ///< its global light is that of a picture at rest
    std::vector<std::unique_ptr<FibletBuffers>> fiblets;  ///< one per layer, where it has fibres
    std::unique_ptr<FibletLineBuffers> fiblet_lines;      ///< only while fibres are drawn by other pipelines than atomic
    std::unique_ptr<RasterBuffers> raster;                ///< only while frames are drawn as triangles

    /// Buffers for a picture of this size; what fits is kept. \throws Error(kResourceExhausted)
    void prepare(gpu::Device& device, int new_width, int new_height, std::size_t layer_count);

    static constexpr std::uint64_t kLayerOffset = 256;
    static constexpr std::uint64_t kLookOffset = kLayerOffset + 8 * sizeof(shader::GlyphLayerParams);
    static constexpr std::uint64_t kCounterOffset = kLookOffset + 8 * sizeof(shader::LayerLook);
    static constexpr std::uint64_t kParamBytes = kCounterOffset + sizeof(Counters);

    shader::FrameParams& frame() const { return *reinterpret_cast<shader::FrameParams*>(params.mapped().data()); }
    shader::GlyphLayerParams& layer(std::size_t i) const {
        return reinterpret_cast<shader::GlyphLayerParams*>(params.mapped().data() + kLayerOffset)[i];
    }
    shader::LayerLook& look(std::size_t i) const {
        return reinterpret_cast<shader::LayerLook*>(params.mapped().data() + kLookOffset)[i];
    }
    Counters& counters() const { return *reinterpret_cast<Counters*>(params.mapped().data() + kCounterOffset); }
};

/// Replaces a buffer that is too small, with some room to grow.
void ensureBytes(gpu::Device& device, gpu::Buffer& buffer, std::uint64_t bytes, gpu::Memory memory, const char* name);

}  // namespace radiata::render
