// Runs the march over an array of rays against one glyph.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/test/function.glsl"
#include "shaders/test/ray_io.glsl"
#include "sh_basis.glsl"
#include "circle.glsl"

FUNCTION_OVER(RayInput, RayOutput)

#include "shaders/test/glyph_circle.glsl"

RayOutput function(RayInput x) {
    const RayPlane plane = rayPlane(x.origin, x.direction);
    vec2 F[CIRCLE_HARMONICS + 1];
    rayCircle(x.direction, plane.e, F);
    const float radius = push.shared_values.value[SH_COUNT];
    const vec2 start = circleStart(plane.closest, plane.h, x.t_min);
    const CircleHit hit = circleMarch(F, plane.h, radius, start, x.both_lobes != 0u);
    RayOutput result;
    result.t = circleHitParameter(hit, plane.h, plane.closest);
    result.amplitude = circleHitCounts(hit, result.t, x.t_min, radius) ? hit.value : 0.0;
    result.steps = hit.steps;
    result.count = hit.capped ? 1u : 0u;
    result.direction = hit.angle.y * plane.e - hit.angle.x * x.direction;
    return result;
}

FUNCTION_MAIN
