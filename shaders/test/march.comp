// Runs the march over an array of rays against one glyph. Shared values: its coefficients, then its largest radius.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/test/function.glsl"
#include "shaders/test/ray_io.glsl"
#include "sh_basis.glsl"
#include "circle.glsl"
#include "shaders/common/ray_plane.glsl"
#include "shaders/common/circle_march.glsl"

FUNCTION_OVER(RayInput, RayOutput)

RayOutput function(RayInput x) {
    float c[SH_COUNT];
    for (int i = 0; i < SH_COUNT; ++i) c[i] = push.shared_values.value[i];
    const RayPlane plane = rayPlane(x.origin, x.direction);
    vec2 samples[CIRCLE_SAMPLES];
    for (int l = 0; l < CIRCLE_SAMPLES; ++l) {
        samples[l] = shEvaluate(c, kCircleSin[l] * plane.e - kCircleCos[l] * x.direction);
    }
    vec2 F[CIRCLE_HARMONICS + 1];
    circleFourier(samples, F);
    const vec2 start = normalize(vec2(plane.closest - x.t_min, max(plane.h, 1e-30)));
    const CircleHit hit = circleMarch(F, plane.h, push.shared_values.value[SH_COUNT], start, x.both_lobes != 0u);
    RayOutput result;
    result.t = circleHitParameter(hit, plane.h, plane.closest);
    result.amplitude = hit.value;
    result.steps = hit.steps;
    result.count = hit.capped ? 1u : 0u;
    return result;
}

FUNCTION_MAIN
