#include "build/tile_lists.h"

#include <algorithm>
#include <atomic>

#include "base/parallel.h"
#include "build/box_projection.h"

namespace radiata {
namespace {

/// Tiles that the box of a glyph may touch.
PixelRect tileRect(const BoxProjection& projection, const shader::GlyphInstance& glyph, int shift_x, int shift_y) {
    const PixelRect pixels = projection.pixels(glyph);
    if (pixels.empty()) return pixels;
    return {pixels.x0 >> shift_x, pixels.y0 >> shift_y, pixels.x1 >> shift_x, pixels.y1 >> shift_y};
}

}  // namespace

TileLists buildTileLists(std::span<const shader::GlyphInstance> instances, const shader::CameraRays& rays, int width,
                         int height, int tile_shift_x, int tile_shift_y, std::size_t entries_max) {
    TileLists lists;
    lists.tiles_x = (width + (1 << tile_shift_x) - 1) >> tile_shift_x;
    lists.tiles_y = (height + (1 << tile_shift_y) - 1) >> tile_shift_y;
    lists.ranges.assign(static_cast<std::size_t>(lists.tiles_x) * lists.tiles_y, glm::uvec2(0));
    const BoxProjection projection(rays, width, height);
    std::vector<PixelRect> rects(instances.size());
    parallelFor(instances.size(), 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            rects[i] = tileRect(projection, instances[i], tile_shift_x, tile_shift_y);
        }
    });
    std::size_t total = 0;
    for (const PixelRect& rect : rects) {
        if (!rect.empty())
            total += static_cast<std::size_t>(rect.x1 - rect.x0 + 1) * static_cast<std::size_t>(rect.y1 - rect.y0 + 1);
        if (total > entries_max) {
            lists.complete = false;
            return lists;
        }
    }
    auto forEachTile = [&](const PixelRect& rect, auto&& visit) {
        for (int y = rect.y0; y <= rect.y1; ++y) {
            for (int x = rect.x0; x <= rect.x1; ++x) visit(lists.ranges[static_cast<std::size_t>(y) * lists.tiles_x + x]);
        }
    };
    for (const PixelRect& rect : rects) forEachTile(rect, [](glm::uvec2& range) { ++range.y; });
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
