#include "reference/inside_length.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "reference/glyph_hits.h"

namespace radiata::reference {

bool insideGlyph(const ShFunction& f, const glm::dvec3& p, bool both_lobes) {
    const double amplitude = f(p);
    return glm::length(p) < (both_lobes ? std::abs(amplitude) : amplitude);
}

double insideLength(const ShFunction& f, const glm::dvec3& origin, const glm::dvec3& direction, double begin, double end,
                    bool both_lobes) {
    if (!(begin < end)) return 0;
    // The nearest point to the centre parts the lobes of a ray through the centre itself, which is no hit.
    std::vector<double> borders{begin, end, std::clamp(-glm::dot(origin, direction), begin, end)};
    for (const GlyphHit& hit : glyphHits(f, origin, direction, both_lobes).hits) {
        if (hit.t > begin && hit.t < end) borders.push_back(hit.t);
    }
    std::ranges::sort(borders);
    double length = 0;
    for (std::size_t i = 1; i < borders.size(); ++i) {
        const double middle = 0.5 * (borders[i - 1] + borders[i]);
        const glm::dvec3 p = origin + middle * direction;
        if (borders[i] > borders[i - 1] && glm::length(p) > 0 && insideGlyph(f, p, both_lobes)) {
            length += borders[i] - borders[i - 1];
        }
    }
    return length;
}

}  // namespace radiata::reference
