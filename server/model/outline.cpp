#include "model/outline.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/error.h"

namespace radiata::model {
namespace {

/// Even-odd rule; an edge belongs to the rows from its upper end on, up to its lower one.
bool isInside(std::span<const glm::dvec2> outline, const glm::dvec2& p) {
    bool inside = false;
    for (std::size_t i = 0, k = outline.size() - 1; i < outline.size(); k = i++) {
        const glm::dvec2 &a = outline[i], &b = outline[k];
        if ((a.y > p.y) == (b.y > p.y)) continue;
        if (p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
    }
    return inside;
}

}  // namespace

OutlinePixels pixelsIn(std::span<const glm::dvec2> outline, const glm::ivec2& picture) {
    if (outline.empty() || outline.size() > kOutlinePointsMax) {
        throw Error(Code::kInvalidArgument, "outline has " + std::to_string(outline.size()) + " points; it must have 1 to " +
                                                std::to_string(kOutlinePointsMax));
    }
    glm::dvec2 low = outline[0], high = outline[0];
    for (const glm::dvec2& p : outline) {
        if (!std::isfinite(p.x) || !std::isfinite(p.y))
            throw Error(Code::kInvalidArgument, "outline has a point that is not finite");
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    std::vector<glm::dvec2> box;
    if (outline.size() == 1) low = glm::floor(low), high = low + 1.0;
    if (outline.size() <= 2) {
        box = {low, {high.x, low.y}, high, {low.x, high.y}};
        outline = box;
    }
    OutlinePixels pixels;
    const glm::dvec2 first = glm::clamp(glm::floor(low), glm::dvec2(0), glm::dvec2(picture));
    const glm::dvec2 end = glm::clamp(glm::ceil(high), glm::dvec2(0), glm::dvec2(picture));
    if (glm::any(glm::lessThanEqual(end, first))) return pixels;
    pixels.first = glm::ivec2(first);
    pixels.size = glm::ivec2(end - first);
    for (int y = 0; y < pixels.size.y; ++y) {
        for (int x = 0; x < pixels.size.x; ++x)
            pixels.inside.push_back(isInside(outline, first + glm::dvec2(x + 0.5, y + 0.5)));
    }
    return pixels;
}

}  // namespace radiata::model
