// What drawing glyphs as triangles needs beside the buffers that every frame has. A view has one only while its frames are
// drawn so.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "build/visible_glyphs.h"
#include "gpu/buffer.h"
#include "gpu/raster_target.h"
#include "model/tessellation.h"
#include "render/frame/pass_run.h"

namespace radiata::render {

/// Glyphs of one layer that the camera of the first sample sees.
struct RasterLayer {
    VisibleGlyphs visible;
    gpu::Buffer list;      ///< their order on the device
    gpu::Buffer vertices;  ///< of deformed spheres; all of the layer, or of one part after the other
    bool keeps_all = false;
};

struct RasterBuffers {
    gpu::RasterTarget images;
    gpu::Buffer words, depth;    ///< of the images, for the pass that writes the surface buffer
    gpu::Buffer nearest, steps;  ///< uint per pixel, for boxes
    gpu::Buffer view;            ///< shader::RasterView of the sample
    gpu::Buffer box_triangles;   ///< 36 indices
    std::optional<model::Tessellation> mesh;
    gpu::Buffer directions, mesh_triangles;
    std::uint32_t vertex_count = 0, index_count = 0;  ///< of the mesh
    std::vector<RasterLayer> layers;
    gpu::Buffer surface_meshes;  ///< shader::SurfaceMeshParams[layers]; only once an isosurface was drawn as triangles

    /// Makes room for the target's size and the plan's method, and finds what the camera sees. For the first sample.
    /// \throws Error(kResourceExhausted) if the device draws no picture as large
    void prepare(gpu::Device& device, const Target::Impl& target, const DrawList& list);

private:
    void prepareMesh(gpu::Device& device, const model::Tessellation& tessellation);
    void prepareLayer(gpu::Device& device, const Target::Impl& target, const DrawList& list, std::size_t index);
};

/// Bytes of deformed vertices kept at a time; a mesh has at most model::kMeshVerticesMax.
constexpr std::uint64_t kVertexBytes = 32ULL << 20;

}  // namespace radiata::render
