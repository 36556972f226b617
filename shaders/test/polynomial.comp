// Runs the polynomial ray test over an array of rays against one glyph, whose coefficients are the shared values; in double with
// POLYNOMIAL_DOUBLE. Output: count of hits, Newton steps, then t and amplitude of each: all of the line, or the first one only.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/test/function.glsl"
#include "shaders/test/ray_io.glsl"
#include "sh_basis.glsl"
#include "polynomial.glsl"

layout(constant_id = 1) const bool kPolynomialStopOnBracket = false;
layout(constant_id = 2) const float kPolynomialTolerance = 2e-4;
layout(constant_id = 3) const bool kAllHits = false;

const int kMost = POLYNOMIAL_DEGREE * (POLYNOMIAL_ODD + 1);  // POLYNOMIAL_HITS_MAX

struct Hits {
    float count, steps;
    vec2 t_and_amplitude[kMost];
};

FUNCTION_OVER(RayInput, Hits)

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

Hits function(RayInput x) {
    for (int i = 0; i < SH_COUNT; ++i) coefficients[i] = push.shared_values.value[i];
    Hits result;
    for (int i = 0; i < kMost; ++i) result.t_and_amplitude[i] = vec2(0.0);
    if (kAllHits) {
        float t[POLYNOMIAL_HITS_MAX], amplitude[POLYNOMIAL_HITS_MAX];
        const int count = polynomialAllHits(x.origin, x.direction, t, amplitude);
        result.count = float(count);
        result.steps = 0.0;
        for (int i = 0; i < count; ++i) result.t_and_amplitude[i] = vec2(t[i], amplitude[i]);
    } else {
        const GlyphHit hit = polynomialFirstHit(x.origin, x.direction, x.t_min, x.both_lobes != 0u);
        result.count = hit.amplitude != 0.0 ? 1.0 : 0.0;
        result.steps = float(hit.steps);
        result.t_and_amplitude[0] = vec2(hit.t, hit.amplitude);
    }
    return result;
}

FUNCTION_MAIN
