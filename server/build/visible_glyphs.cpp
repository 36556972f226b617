#include "build/visible_glyphs.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/parallel.h"

namespace radiata {

VisibleGlyphs visibleGlyphs(std::span<const shader::GlyphInstance> instances, const shader::CameraRays& rays, int width,
                            int height) {
    const BoxProjection projection(rays, width, height);
    std::vector<PixelRect> rects(instances.size());
    parallelFor(instances.size(), 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) rects[i] = projection.pixels(instances[i]);
    });
    std::vector<std::pair<float, std::uint32_t>> seen;
    for (std::uint32_t i = 0; i < instances.size(); ++i) {
        if (!rects[i].empty()) seen.emplace_back(projection.depth(instances[i]), i);
    }
    std::ranges::sort(seen);
    VisibleGlyphs visible;
    visible.order.reserve(seen.size());
    visible.pixels.reserve(seen.size());
    for (const auto& [depth, index] : seen) {
        visible.order.push_back(index);
        visible.pixels.push_back(rects[index]);
    }
    return visible;
}

DrawPart nextPart(const VisibleGlyphs& glyphs, std::uint32_t next, std::uint32_t row, double work_wanted, double work_per_glyph,
                  std::uint32_t count_max, int height) {
    DrawPart part{next, 1, row, static_cast<std::uint32_t>(height) - row, 0};
    const PixelRect& first = glyphs.pixels[next];
    const double first_work = first.area() + work_per_glyph;
    if (row > 0 || first_work > work_wanted) {
        // Rows outside of the box cost nothing: a band reaches from one wanted amount of the box to the next.
        const double row_work = first_work / (first.y1 - first.y0 + 1.0);
        const double begin = std::max<double>(row, first.y0);
        const double end = begin + std::max(1.0, std::floor(work_wanted / row_work));
        if (end <= first.y1) part.rows = static_cast<std::uint32_t>(end) - row;
        part.work = (std::min(end, first.y1 + 1.0) - begin) * row_work;
        return part;
    }
    part.work = first_work;
    while (part.count < count_max && part.first + part.count < glyphs.order.size()) {
        const double work = glyphs.pixels[part.first + part.count].area() + work_per_glyph;
        if (part.work + work > work_wanted) break;
        part.work += work;
        ++part.count;
    }
    return part;
}

}  // namespace radiata
