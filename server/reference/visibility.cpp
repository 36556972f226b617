#include "reference/visibility.h"

#include <algorithm>
#include <cmath>

#include "reference/glyph_hits.h"

namespace radiata::reference {
namespace {

constexpr double kStart = 1e-4;  // radii

}  // namespace

Visibility visibilityOf(std::span<const PlacedGlyph> glyphs, const glm::dvec3& origin_mm, const glm::dvec3& direction,
                        bool both_lobes, int own, double t_max) {
    Visibility result;
    for (std::size_t i = 0; i < glyphs.size(); ++i) {
        const PlacedGlyph& glyph = glyphs[i];
        const glm::dvec3 origin = (origin_mm - glyph.centre_mm) / glyph.scale;
        const double end = t_max / glyph.scale;
        const double size = std::max(glm::length(origin), 1e-12);
        const GlyphHits found = glyphHits(*glyph.f, origin, direction, both_lobes);
        bool blocked = false;
        for (const GlyphHit& hit : found.hits) {
            const bool at_start = std::abs(hit.t) < kStart * size;
            if (at_start && static_cast<int>(i) == own) continue;
            if (at_start || std::abs(hit.t - end) < kStart * size) result.sure = false;
            blocked = blocked || (hit.t > 0 && hit.t < end);
        }
        result.blocked = result.blocked || blocked;
        result.sure = result.sure && !found.grazing;
    }
    return result;
}

}  // namespace radiata::reference
