// Ray against glyph by marching with steps of equal length and bisection, for comparison with the certified march.
// Source: Peeters et al. 2009, as Peters et al. 2023, Sec. 2, describe it: the part of the ray in the bounding sphere is cut into kMarchSteps
// pieces, the function is evaluated anew at the end of each, and the first piece whose ends are on different sides of the surface is bisected
// kMarchRefinements times (both specialisation constants). What enters and leaves the glyph within one piece is not seen.
// The includer provides, before including,   float shEvaluate(vec3 direction);
#ifndef RADIATA_COMMON_MARCH_PEETERS
#define RADIATA_COMMON_MARCH_PEETERS
#include "shaders/common/glyph_hit.glsl"

// \param span  first and last ray parameter to search, within the bounding sphere
GlyphHit peetersFirstHit(vec3 o, vec3 d, vec2 span, bool both_lobes) {
    GlyphHit hit = GlyphHit(0.0, 0.0, 0u);
    if (!(span.x < span.y)) return hit;
    const float piece = (span.y - span.x) / float(kMarchSteps);
    float low = span.x;
    bool begins_inside = false;
    for (uint i = 0u; i <= kMarchSteps; ++i) {
        const float t = span.x + float(i) * piece;
        const vec3 p = o + t * d;
        const float radius = length(p);
        const float f = shEvaluate(p / max(radius, 1e-30));
        const bool inside = (both_lobes ? abs(f) : f) > radius;
        ++hit.steps;
        if (i == 0u) begins_inside = inside;
        if (inside != begins_inside) {
            float high = t;
            for (uint refinement = 0u; refinement < kMarchRefinements; ++refinement) {
                const float middle = 0.5 * (low + high);
                const vec3 q = o + middle * d;
                const float distance = length(q);
                const float value = shEvaluate(q / max(distance, 1e-30));
                const bool middle_inside = (both_lobes ? abs(value) : value) > distance;
                ++hit.steps;
                low = middle_inside == begins_inside ? middle : low;
                high = middle_inside == begins_inside ? high : middle;
            }
            hit.t = 0.5 * (low + high);
            const vec3 q = o + hit.t * d;
            const float value = shEvaluate(normalize(q));
            const float distance = max(length(q), 1e-30);
            hit.amplitude = both_lobes && value < 0.0 ? -distance : distance;
            return hit;
        }
        low = t;
    }
    return hit;
}

#endif
