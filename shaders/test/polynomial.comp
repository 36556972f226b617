// Runs the polynomial ray test over an array of rays against one glyph, whose coefficients are the shared values; in double with
// POLYNOMIAL_DOUBLE. All hits of a line: glyph/all_hits.comp.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/test/function.glsl"
#include "shaders/test/ray_io.glsl"
#include "sh_basis.glsl"
#include "polynomial.glsl"

layout(constant_id = 1) const bool kPolynomialStopOnBracket = false;
layout(constant_id = 2) const float kPolynomialTolerance = 2e-4;

FUNCTION_OVER(RayInput, RayOutput)

float coefficients[SH_COUNT];
#ifdef POLYNOMIAL_DOUBLE
double shEvaluate(dvec3 direction) { return shEvaluateDouble(coefficients, direction).x; }
#else
float shEvaluate(vec3 direction) {
    const vec2 parts = shEvaluate(coefficients, direction);
    return POLYNOMIAL_ODD != 0 ? parts.y : parts.x;
}
#endif

#include "shaders/common/polynomial_hit.glsl"

RayOutput function(RayInput x) {
    for (int i = 0; i < SH_COUNT; ++i) coefficients[i] = push.shared_values.value[i];
    const GlyphHit hit = polynomialFirstHit(x.origin, x.direction, x.t_min, x.both_lobes != 0u);
    return RayOutput(hit.t, hit.amplitude, hit.steps, 0u, vec3(0.0));
}

FUNCTION_MAIN
