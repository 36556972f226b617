#include "build/tile_lists.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include "base/parallel.h"

namespace radiata {
namespace {

struct TileRect {
    int x0 = 0, y0 = 0, x1 = -1, y1 = -1;  // inclusive; empty if x1 < x0
};

/// The camera as a projection to pixels: point -> (right, up) pixel coordinates from the picture's centre.
struct Projection {
    glm::vec3 right, up;  // pixels per mm
    glm::vec3 forward;
    float inverse_distance, near_depth, far_depth;

    explicit Projection(const shader::CameraRays& rays)
        : right(rays.step_right / glm::dot(rays.step_right, rays.step_right)),
          up(rays.step_up / glm::dot(rays.step_up, rays.step_up)),
          forward(rays.forward),
          inverse_distance(rays.inverse_distance),
          near_depth(rays.near_depth),
          far_depth(rays.far_depth) {}
};

glm::vec3 centreFromReference(const shader::GlyphInstance& glyph, const shader::CameraRays& rays) {
    return (glyph.centre_high - rays.reference_high) + (glyph.centre_low - rays.reference_low);
}

/// Bounds of a box in pixels from the picture's centre. \return false if the box is out of the depth range
bool projectBox(const Projection& projection, const glm::vec3& centre, const glm::vec3& low, const glm::vec3& high,
                glm::vec2& minimum, glm::vec2& maximum) {
    const glm::vec3 middle = centre + 0.5F * (low + high), half = 0.5F * (high - low);
    const float depth = glm::dot(middle, projection.forward), depth_half = glm::dot(half, glm::abs(projection.forward));
    if (depth + depth_half < projection.near_depth || depth - depth_half > projection.far_depth) return false;
    const glm::vec2 at(glm::dot(middle, projection.right), glm::dot(middle, projection.up));
    const glm::vec2 half_size(glm::dot(half, glm::abs(projection.right)), glm::dot(half, glm::abs(projection.up)));
    // Perspective divides by 1 + depth / distance, which is monotonic: its extremes over the box bound all quotients.
    const float nearest = 1 + (depth - depth_half) * projection.inverse_distance;
    const float farthest = 1 + (depth + depth_half) * projection.inverse_distance;
    if (nearest <= 1e-4F) {
        minimum = glm::vec2(-std::numeric_limits<float>::max());
        maximum = glm::vec2(std::numeric_limits<float>::max());
        return true;
    }
    const glm::vec2 first = at - half_size, last = at + half_size;
    minimum = glm::min(first / nearest, first / farthest);
    maximum = glm::max(last / nearest, last / farthest);
    return true;
}

TileRect tileRect(const Projection& projection, const shader::GlyphInstance& glyph, const shader::CameraRays& rays, int width,
                  int height, int shift_x, int shift_y) {
    glm::vec2 minimum, maximum;
    if (!projectBox(projection, centreFromReference(glyph, rays), glyph.box_min, glyph.box_max, minimum, maximum)) return {};
    const float w = static_cast<float>(width), h = static_cast<float>(height);
    auto pixel = [](float value, float limit) { return static_cast<int>(std::floor(std::clamp(value, -1.0F, limit))); };
    const int x0 = pixel(minimum.x + 0.5F * w - 1, w), x1 = pixel(maximum.x + 0.5F * w + 1, w);
    const int y0 = pixel(0.5F * h - maximum.y - 1, h), y1 = pixel(0.5F * h - minimum.y + 1, h);
    if (x1 < 0 || y1 < 0 || x0 >= width || y0 >= height) return {};
    return {std::max(x0, 0) >> shift_x, std::max(y0, 0) >> shift_y, std::min(x1, width - 1) >> shift_x,
            std::min(y1, height - 1) >> shift_y};
}

}  // namespace

TileLists buildTileLists(std::span<const shader::GlyphInstance> instances, const shader::CameraRays& rays, int width,
                         int height, int tile_shift_x, int tile_shift_y, std::size_t entries_max) {
    TileLists lists;
    lists.tiles_x = (width + (1 << tile_shift_x) - 1) >> tile_shift_x;
    lists.tiles_y = (height + (1 << tile_shift_y) - 1) >> tile_shift_y;
    lists.ranges.assign(static_cast<std::size_t>(lists.tiles_x) * lists.tiles_y, glm::uvec2(0));
    const Projection projection(rays);
    std::vector<TileRect> rects(instances.size());
    parallelFor(instances.size(), 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            rects[i] = tileRect(projection, instances[i], rays, width, height, tile_shift_x, tile_shift_y);
        }
    });
    std::size_t total = 0;
    for (const TileRect& rect : rects) {
        if (rect.x1 >= rect.x0)
            total += static_cast<std::size_t>(rect.x1 - rect.x0 + 1) * static_cast<std::size_t>(rect.y1 - rect.y0 + 1);
        if (total > entries_max) {
            lists.complete = false;
            return lists;
        }
    }
    auto forEachTile = [&](const TileRect& rect, auto&& visit) {
        for (int y = rect.y0; y <= rect.y1; ++y) {
            for (int x = rect.x0; x <= rect.x1; ++x) visit(lists.ranges[static_cast<std::size_t>(y) * lists.tiles_x + x]);
        }
    };
    for (const TileRect& rect : rects) forEachTile(rect, [](glm::uvec2& range) { ++range.y; });
    std::uint32_t first = 0;
    for (glm::uvec2& range : lists.ranges) {
        range.x = first;
        first += range.y;
        range.y = 0;
    }
    lists.entries.resize(first);
    for (std::size_t i = 0; i < rects.size(); ++i) {
        forEachTile(rects[i], [&](glm::uvec2& range) { lists.entries[range.x + range.y++] = static_cast<std::uint32_t>(i); });
    }
    return lists;
}

}  // namespace radiata
