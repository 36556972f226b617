// All crossings of an array of rays with one glyph. Output: count, begins inside, steps, gave up, then t and value of each.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/test/function.glsl"
#include "shaders/test/ray_io.glsl"
#include "sh_basis.glsl"
#include "circle.glsl"

const int kMost = (CIRCLE_STRIDE == 1.0 ? 4 : 2) * (SH_K + 1);  // CIRCLE_HITS_MAX

struct Crossings {
    float count, begins_inside, steps, capped;
    vec2 t_and_value[kMost];
};

FUNCTION_OVER(RayInput, Crossings)

#include "shaders/test/glyph_circle.glsl"
#include "shaders/common/circle_all_hits.glsl"

Crossings function(RayInput x) {
    const RayPlane plane = rayPlane(x.origin, x.direction);
    vec2 F[CIRCLE_HARMONICS + 1];
    rayCircle(x.direction, plane.e, F);
    const vec2 start = circleStart(plane.closest, plane.h, x.t_min);
    vec3 hits[CIRCLE_HITS_MAX];
    bool begins_inside, capped;
    uint steps;
    const int count =
        circleAllHits(F, plane.h, push.shared_values.value[SH_COUNT], start, x.both_lobes != 0u, hits, begins_inside, steps, capped);
    Crossings result;
    result.count = float(count);
    result.begins_inside = begins_inside ? 1.0 : 0.0;
    result.steps = float(steps);
    result.capped = capped ? 1.0 : 0.0;
    for (int i = 0; i < CIRCLE_HITS_MAX; ++i) {
        result.t_and_value[i] = vec2(0.0);
        if (i < count) {
            const CircleHit hit = CircleHit(hits[i].xy, hits[i].z, 0u, false);
            result.t_and_value[i] = vec2(circleHitParameter(hit, plane.h, plane.closest), hit.value);
        }
    }
    return result;
}

FUNCTION_MAIN
