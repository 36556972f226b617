// Runs Laguerre's method over an array of rays against one glyph, whose coefficients are the shared values.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/test/function.glsl"
#include "shaders/test/ray_io.glsl"
#include "sh_basis.glsl"
#include "polynomial.glsl"

layout(constant_id = 1) const float kLaguerreReal = 1e-3;

FUNCTION_OVER(RayInput, RayOutput)

float coefficients[SH_COUNT];
float shEvaluate(vec3 direction) { return shEvaluate(coefficients, direction).x; }

#include "shaders/common/laguerre_hit.glsl"

RayOutput function(RayInput x) {
    for (int i = 0; i < SH_COUNT; ++i) coefficients[i] = push.shared_values.value[i];
    const GlyphHit hit = laguerreFirstHit(x.origin, x.direction, x.t_min, x.both_lobes != 0u);
    return RayOutput(hit.t, hit.amplitude, hit.steps, 0u, vec3(0.0));
}

FUNCTION_MAIN
