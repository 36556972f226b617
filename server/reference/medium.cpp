#include "reference/medium.h"

#include <cmath>

#include "reference/inside_length.h"

namespace radiata::reference {

glm::dvec3 throughMedia(const std::vector<MediumGlyph>& glyphs, const glm::dvec3& origin, const glm::dvec3& direction,
                        double begin, double end, bool both_lobes, const glm::dvec3& behind, int steps) {
    const double step = (end - begin) / steps;
    glm::dvec3 radiance(0);
    double transmittance = 1;
    for (int i = 0; i < steps; ++i) {
        const glm::dvec3 p = origin + (begin + (i + 0.5) * step) * direction;
        double extinction = 0;
        glm::dvec3 emitted(0);
        for (const MediumGlyph& glyph : glyphs) {
            const glm::dvec3 local = (p - glyph.centre) / glyph.scale;
            if (!(glm::length(local) > 0) || !insideGlyph(*glyph.function, local, both_lobes)) continue;
            extinction += glyph.extinction;
            emitted += glyph.extinction * glyph.emission;
        }
        if (extinction == 0) continue;
        const double passed = std::exp(-extinction * step);
        radiance += transmittance * (1 - passed) * emitted / extinction;
        transmittance *= passed;
    }
    return radiance + transmittance * behind;
}

}  // namespace radiata::reference
