#include "render/frame/outputs.h"

#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "gpu/device.h"
#include "store/volume_dataset.h"

namespace radiata::render {
namespace {

constexpr std::uint32_t kNobody = 0xffffffffU;

/// Pixel rays in double from the camera's float parameters: the rays that the device used, evaluated more exactly.
struct RayOfPixel {
    glm::dvec3 origin, direction;
    double stretch;  // of the ray parameter against the depth

    RayOfPixel(const shader::CameraRays& rays, int width, int height, int x, int y) {
        origin = (x + 0.5 - 0.5 * width) * glm::dvec3(rays.step_right) + (0.5 * height - y - 0.5) * glm::dvec3(rays.step_up);
        direction = origin * static_cast<double>(rays.inverse_distance) + glm::dvec3(rays.forward);
        stretch = glm::length(direction);
        direction /= stretch;
    }
};

void resizeArrays(const model::Outputs& wanted, std::size_t count, model::FramePixels& pixels) {
    if (wanted.depth) pixels.depth.assign(count, std::numeric_limits<float>::infinity());
    if (wanted.id) pixels.id.assign(4 * count, -1);
    if (wanted.position) pixels.position.assign(3 * count, std::numeric_limits<float>::quiet_NaN());
    if (wanted.normal) pixels.normal.assign(3 * count, 0.0F);
    if (wanted.steps) pixels.steps.assign(count, 0);
}

/// Of a glyph its own; of an isosurface the nearest. \param position  relative to the frame's reference point
glm::ivec3 voxelOf(const DrawList& list, const DrawnLayer& layer, const shader::Surface& surface, const glm::dvec3& position) {
    if (layer.glyphs) {
        const GlyphScene& scene = *layer.glyphs;
        return scene.dataset().image().voxels[scene.instances()[surface.who].slot];
    }
    const glm::ivec3 nearest(glm::round(layer.volume->worldToGrid(list.camera.reference_mm + position)));
    return glm::clamp(nearest, glm::ivec3(0), layer.volume->params().size - 1);
}

void writeHit(const model::Outputs& wanted, const DrawList& list, const shader::Surface& surface, const RayOfPixel& ray,
              std::size_t at, model::FramePixels& pixels) {
    const std::uint32_t layer = surface.layer_and_steps >> 24U;
    const glm::dvec3 position = ray.origin + static_cast<double>(surface.depth) * ray.direction;
    if (wanted.depth) pixels.depth[at] = static_cast<float>(surface.depth / ray.stretch);
    if (wanted.id && list.layers[layer].tracts) {
        const model::FibletHead& head = list.layers[layer].tracts->set().heads[surface.who >> shader::FIBLET_SEGMENT_BITS];
        const std::uint32_t segment = surface.who & ((1U << shader::FIBLET_SEGMENT_BITS) - 1);
        pixels.id[4 * at] = static_cast<std::int32_t>(layer);
        pixels.id[4 * at + 1] = static_cast<std::int32_t>(head.fibre);
        pixels.id[4 * at + 2] = static_cast<std::int32_t>(shader::FIBLET_SEGMENTS * model::fibletIndex(head) + segment);
        pixels.id[4 * at + 3] = 0;
    } else if (wanted.id) {
        const glm::ivec3 voxel = voxelOf(list, list.layers[layer], surface, position);
        pixels.id[4 * at] = static_cast<std::int32_t>(layer);
        for (int c = 0; c < 3; ++c) pixels.id[4 * at + 1 + c] = voxel[c];
    }
    for (int c = 0; c < 3; ++c) {
        if (wanted.position) pixels.position[3 * at + c] = static_cast<float>(position[c]);
        if (wanted.normal) pixels.normal[3 * at + c] = surface.normal[c];
    }
}

}  // namespace

void readOutputs(gpu::Device& device, Drawer& drawer, Target::Impl& target, const DrawList& list, const model::Outputs& wanted,
                 model::FramePixels& pixels) {
    const std::size_t count = static_cast<std::size_t>(target.width) * static_cast<std::size_t>(target.height);
    const std::uint64_t bytes = count * sizeof(shader::Surface);
    if (!target.surface_readback) {
        target.surface_readback = gpu::Buffer(device, bytes, gpu::Memory::kReadback, "surface read-back");
    }
    drawer.recorder().copy(target.surface, 0, target.surface_readback, 0, bytes);
    drawer.recorder().submitAndWait();
    const std::span<const shader::Surface> surfaces = target.surface_readback.as<shader::Surface>();
    resizeArrays(wanted, count, pixels);
    parallelFor(static_cast<std::size_t>(target.height), 16, [&](std::size_t begin, std::size_t end) {
        for (std::size_t y = begin; y < end; ++y) {
            for (int x = 0; x < target.width; ++x) {
                const std::size_t at = y * static_cast<std::size_t>(target.width) + static_cast<std::size_t>(x);
                if (wanted.steps) pixels.steps[at] = static_cast<std::int32_t>(surfaces[at].layer_and_steps & 0xffffffU);
                if (surfaces[at].who == kNobody) continue;
                writeHit(wanted, list, surfaces[at],
                         RayOfPixel(list.camera.rays, target.width, target.height, x, static_cast<int>(y)), at, pixels);
            }
        }
    });
}

void copyPicture(const Target::Impl& target, model::FramePixels& pixels) {
    pixels.width = target.width;
    pixels.height = target.height;
    const std::size_t bytes = static_cast<std::size_t>(target.width) * static_cast<std::size_t>(target.height) * 4;
    const auto picture = target.picture.as<std::uint8_t>().first(bytes);
    pixels.rgba.assign(picture.begin(), picture.end());
}

}  // namespace radiata::render
