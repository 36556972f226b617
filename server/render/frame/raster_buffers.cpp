#include "render/frame/raster_buffers.h"

#include <algorithm>
#include <array>

#include "build/sphere_mesh.h"
#include "gpu/device.h"
#include "shaders/shared/raster.glsl"

namespace radiata::render {
namespace {

static_assert(model::kMeshVerticesMax * sizeof(shader::MeshVertex) <= kVertexBytes);

/// Twelve triangles, counter-clockwise seen from outside, of corners whose bits 0, 1, 2 stand for the upper x, y, z.
constexpr std::array<std::uint32_t, 36> kBoxTriangles{0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                                      2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};

template <typename T>
void fillBuffer(gpu::Device& device, gpu::Buffer& buffer, std::span<const T> values, const char* name) {
    ensureBytes(device, buffer, std::max<std::uint64_t>(values.size_bytes(), 4), gpu::Memory::kDevice, name);
    gpu::upload(device, buffer, 0, std::as_bytes(values));
}

}  // namespace

void RasterBuffers::prepare(gpu::Device& device, const Target::Impl& target, const DrawList& list) {
    const auto width = static_cast<std::uint32_t>(target.width), height = static_cast<std::uint32_t>(target.height);
    const std::uint64_t pixels = std::uint64_t{width} * height;
    const model::Quality& quality = list.plan->resolved.quality;
    const bool tessellated = quality.intersection == model::Intersection::kTessellated;
    const bool boxes = !tessellated && quality.traversal == model::Traversal::kRasterBoxes;
    if (!images || images.width() != width || images.height() != height) {
        images = gpu::RasterTarget();
        images = gpu::RasterTarget(device, width, height);
        words = gpu::Buffer(device, pixels * gpu::RasterTarget::kWordBytesPerPixel, gpu::Memory::kDevice, "drawn words");
        depth = gpu::Buffer(device, pixels * gpu::RasterTarget::kDepthBytesPerPixel, gpu::Memory::kDevice, "drawn depth");
        for (gpu::Buffer* buffer : {&nearest, &steps}) *buffer = gpu::Buffer();
    }
    if (!view) view = gpu::Buffer(device, sizeof(shader::RasterView), gpu::Memory::kUpload, "raster view");
    if (boxes) {
        if (!nearest) nearest = gpu::Buffer(device, pixels * 4, gpu::Memory::kDevice, "nearest hits");
        if (!steps) steps = gpu::Buffer(device, pixels * 4, gpu::Memory::kDevice, "march steps");
        if (!box_triangles) fillBuffer(device, box_triangles, std::span<const std::uint32_t>(kBoxTriangles), "box triangles");
        mesh.reset();
        for (gpu::Buffer* buffer : {&directions, &mesh_triangles}) *buffer = gpu::Buffer();
    } else {
        for (gpu::Buffer* buffer : {&nearest, &steps}) *buffer = gpu::Buffer();
        if (tessellated) prepareMesh(device, quality.tessellation);
    }
    if (!boxes && !tessellated) return;
    layers.resize(list.layers.size());
    for (std::size_t i = 0; i < layers.size(); ++i) {
        if (list.layers[i].glyphs) prepareLayer(device, target, list, i);
    }
}

void RasterBuffers::prepareMesh(gpu::Device& device, const model::Tessellation& tessellation) {
    if (mesh && mesh->mesh == tessellation.mesh && mesh->level == tessellation.level) return;
    const SphereTriangles sphere = sphereMesh(tessellation.mesh, tessellation.level);
    fillBuffer(device, directions, std::span(sphere.directions), "mesh directions");
    fillBuffer(device, mesh_triangles, std::span(sphere.triangles), "mesh triangles");
    vertex_count = static_cast<std::uint32_t>(sphere.directions.size());
    index_count = static_cast<std::uint32_t>(sphere.triangles.size());
    mesh = tessellation;
}

void RasterBuffers::prepareLayer(gpu::Device& device, const Target::Impl& target, const DrawList& list, std::size_t index) {
    RasterLayer& layer = layers[index];
    layer.visible = visibleGlyphs(list.layers[index].glyphs->instances(), list.camera.rays, target.width, target.height);
    fillBuffer(device, layer.list, std::span<const std::uint32_t>(layer.visible.order), "glyphs to draw");
    if (!mesh) {
        layer.vertices = gpu::Buffer();
        return;
    }
    const std::uint64_t bytes_per_glyph = std::uint64_t{vertex_count} * sizeof(shader::MeshVertex);
    const std::uint64_t all = bytes_per_glyph * std::max<std::size_t>(layer.visible.order.size(), 1);
    layer.keeps_all = all <= kVertexBytes;
    ensureBytes(device, layer.vertices, std::min(all, kVertexBytes), gpu::Memory::kDevice, "glyph vertices");
}

}  // namespace radiata::render
