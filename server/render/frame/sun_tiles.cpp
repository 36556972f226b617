#include "render/frame/sun_tiles.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "build/tile_lists.h"
#include "gpu/device.h"

namespace radiata::render {
namespace {

constexpr int kShift = 2;  // pixels per tile, log2: lists are enlarged by a pixel
constexpr double kTilesMax = 1e6;
constexpr std::size_t kEntriesMax = 24'000'000;

}  // namespace

SunTiles sunTiles(const DrawList& list) {
    const glm::dvec3 light = list.light_direction_world;
    const glm::dvec3 other = std::abs(light.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 right = glm::normalize(glm::cross(light, other)), up = glm::cross(right, light);
    // The largest distance of any glyph from the reference point, along both axes, and the mean size of boxes.
    double half_x = 0, half_y = 0, size = 0, count = 0;
    for (const DrawnLayer& drawn : list.layers) {
        const plan::SceneBounds& bounds = drawn.bounds;
        const glm::dvec3 half = 0.5 * (bounds.maximum - bounds.minimum), middle = bounds.centre() - list.camera.reference_mm;
        half_x = std::max(half_x, std::abs(glm::dot(middle, right)) + glm::dot(half, glm::abs(right)));
        half_y = std::max(half_y, std::abs(glm::dot(middle, up)) + glm::dot(half, glm::abs(up)));
        const GlyphScene* layer = drawn.glyphs;
        if (!layer) continue;
        const std::size_t stride = std::max<std::size_t>(1, layer->instances().size() / 1024);
        for (std::size_t i = 0; i < layer->instances().size(); i += stride) {
            const glm::vec3 box = layer->instances()[i].box_max - layer->instances()[i].box_min;
            size += static_cast<double>(box.x + box.y + box.z) / 3;
            ++count;
        }
    }
    const double smallest =
        std::max({std::sqrt(4 * half_x * half_y / kTilesMax), 2 * half_x / kTilesMax, 2 * half_y / kTilesMax});
    const double tile = std::max({0.5 * size / std::max(count, 1.0), 1.05 * smallest, 1e-20});
    SunTiles tiles;
    tiles.x = 2 * static_cast<int>(std::ceil(half_x / tile)) + 2;
    tiles.y = 2 * static_cast<int>(std::ceil(half_y / tile)) + 2;
    tiles.right = glm::vec3(right / tile);
    tiles.up = glm::vec3(up / tile);
    tiles.rays = list.camera.rays;
    tiles.rays.step_right = glm::vec3(right * (tile / (1 << kShift)));
    tiles.rays.step_up = glm::vec3(up * (tile / (1 << kShift)));
    tiles.rays.forward = glm::vec3(light);
    tiles.rays.inverse_distance = 0;
    tiles.rays.near_depth = -std::numeric_limits<float>::max();
    tiles.rays.far_depth = std::numeric_limits<float>::max();
    return tiles;
}

void listSunBoxes(gpu::Device& device, LayerBuffers& buffers, shader::GlyphLayerParams& params, const GlyphScene& scene,
                  const SunTiles& tiles) {
    const TileLists lists =
        buildTileLists(scene.instances(), tiles.rays, tiles.x << kShift, tiles.y << kShift, kShift, kShift, kEntriesMax);
    if (!lists.complete) {
        throw Error(Code::kResourceExhausted, "scene.light.shadow hard: the glyphs along the light need more than " +
                                                  std::to_string(kEntriesMax) + " list entries; use quality.traversal bvh");
    }
    const std::span ranges(lists.ranges);
    const std::span entries(lists.entries);
    ensureBytes(device, buffers.sun_ranges, ranges.size_bytes(), gpu::Memory::kUpload, "sun tile ranges");
    ensureBytes(device, buffers.sun_entries, std::max<std::size_t>(entries.size_bytes(), 4), gpu::Memory::kUpload,
                "sun tile entries");
    std::ranges::copy(ranges, buffers.sun_ranges.as<glm::uvec2>().begin());
    std::ranges::copy(entries, buffers.sun_entries.as<std::uint32_t>().begin());
    params.sun_ranges = buffers.sun_ranges.address();
    params.sun_lists = buffers.sun_entries.address();
}

}  // namespace radiata::render
