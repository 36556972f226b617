// Runs the polynomial ray test over an array of rays against one glyph, whose coefficients are the shared values.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/test/function.glsl"
#include "shaders/test/ray_io.glsl"
#include "sh_basis.glsl"
#include "polynomial.glsl"

layout(constant_id = 1) const bool kPolynomialStopOnBracket = false;
layout(constant_id = 2) const bool kCountAllHits = false;

FUNCTION_OVER(RayInput, RayOutput)

float coefficients[SH_COUNT];
float shEvaluate(vec3 direction) { return shEvaluate(coefficients, direction).x; }

#include "shaders/common/polynomial_hit.glsl"

RayOutput function(RayInput x) {
    for (int i = 0; i < SH_COUNT; ++i) coefficients[i] = push.shared_values.value[i];
    RayOutput result;
    result.direction = vec3(0.0);
    if (kCountAllHits) {
        float t[POLYNOMIAL_DEGREE];
        result.count = polynomialAllHits(x.origin, x.direction, t);
        result.t = result.count > 0 ? t[result.count - 1] : 0.0;
        result.amplitude = 0.0;
        result.steps = 0u;
    } else {
        const GlyphHit hit = polynomialFirstHit(x.origin, x.direction, x.t_min, x.both_lobes != 0u);
        result.t = hit.t;
        result.amplitude = hit.amplitude;
        result.steps = hit.steps;
        result.count = 0u;
    }
    return result;
}

FUNCTION_MAIN
