// All hits of an array of rays with one glyph, for picks: of the march (common/circle_all_hits.glsl) or, with METHOD_POLYNOMIAL or
// METHOD_LAGUERRE, all real roots of that method. Coefficients are those of the module's layout; a glyph of fewer bands has zeros.
// Source: Peters et al. 2023, Fig. 2 and Sec. 3.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/common/invocation.glsl"
#include "shaders/shared/glyph_rays.glsl"
#include "sh_basis.glsl"

layout(buffer_reference, scalar) readonly buffer Rays { GlyphRay at[]; };
layout(buffer_reference, scalar) readonly buffer Glyph { float value[]; };  // SH_COUNT coefficients, the certified radius
layout(buffer_reference, scalar) writeonly buffer Answers { float word[]; };
layout(push_constant, scalar) uniform Push {
    Rays rays;
    Answers answers;
    Glyph glyph;
    uint count;
} push;

float coefficients[SH_COUNT];

#if defined METHOD_POLYNOMIAL || defined METHOD_LAGUERRE
#include "polynomial.glsl"
#ifdef POLYNOMIAL_DOUBLE
double shEvaluate(dvec3 direction) { return shEvaluateDouble(coefficients, direction).x; }
#else
float shEvaluate(vec3 direction) {
    const vec2 parts = shEvaluate(coefficients, direction);
    return POLYNOMIAL_ODD != 0 ? parts.y : parts.x;
}
#endif
#endif

#if defined METHOD_POLYNOMIAL
layout(constant_id = 1) const bool kPolynomialStopOnBracket = false;
layout(constant_id = 2) const float kPolynomialTolerance = 2e-4;
#include "shaders/common/polynomial_hit.glsl"
#define METHOD_HITS_MAX POLYNOMIAL_HITS_MAX
#define METHOD_HITS polynomialAllHits
#elif defined METHOD_LAGUERRE
layout(constant_id = 1) const float kLaguerreReal = 1e-3;
#include "shaders/common/laguerre_hit.glsl"
#define METHOD_HITS_MAX POLYNOMIAL_DEGREE
#define METHOD_HITS laguerreAllHits
#else
#include "circle.glsl"
#include "shaders/common/ray_plane.glsl"
#include "shaders/common/circle_all_hits.glsl"
#define METHOD_HITS_MAX CIRCLE_HITS_MAX
#endif

struct Found {
    uint count, steps;
    bool gave_up;
    vec3 hits[METHOD_HITS_MAX];  // as the answer has them
};

#ifdef METHOD_HITS
Found allHits(GlyphRay ray) {
    Found found;
    found.count = found.steps = 0u;
    found.gave_up = false;
    vec3 hits[METHOD_HITS_MAX];
    const int count = METHOD_HITS(ray.origin, ray.direction, hits, found.steps);
    for (int i = 0; i < count; ++i) {
        const bool counts = hits[i].x >= ray.t_min && (ray.both_lobes != 0u || hits[i].y > 0.0);
        if (counts) found.hits[found.count++] = hits[i];
    }
    return found;
}
#else
Found allHits(GlyphRay ray) {
    const RayPlane plane = rayPlane(ray.origin, ray.direction);
    vec2 F[CIRCLE_HARMONICS + 1];
    circleFourier(coefficients, ray.direction, plane.e, F);
    const vec2 start = circleStart(plane.closest, plane.h, ray.t_min);
    Found found;
    vec3 hits[CIRCLE_HITS_MAX];
    bool begins_inside;
    found.count = uint(circleAllHits(F, plane.h, push.glyph.value[SH_COUNT], start, ray.both_lobes != 0u, hits, begins_inside,
                                     found.steps, found.gave_up));
    for (uint i = 0u; i < found.count; ++i) {
        const CircleHit hit = CircleHit(hits[i].xy, hits[i].z, 0u, false);
        const bool enters = ((i & 1u) == 0u) != begins_inside;
        found.hits[i] = vec3(circleHitParameter(hit, plane.h, plane.closest), hit.value, enters ? 1.0 : 0.0);
    }
    return found;
}
#endif

void main() {
    const uint index = globalInvocation();
    if (index >= push.count) return;
    for (int i = 0; i < SH_COUNT; ++i) coefficients[i] = push.glyph.value[i];
    const Found found = allHits(push.rays.at[index]);
    const uint first = index * (GLYPH_RAY_HEADER + GLYPH_RAY_WORDS * uint(METHOD_HITS_MAX));
    push.answers.word[first] = float(found.count);
    push.answers.word[first + 1u] = found.gave_up ? 1.0 : 0.0;
    push.answers.word[first + 2u] = float(found.steps);
    for (uint i = 0u; i < found.count; ++i) {
        for (int word = 0; word < 3; ++word) {
            push.answers.word[first + GLYPH_RAY_HEADER + GLYPH_RAY_WORDS * i + uint(word)] = found.hits[i][word];
        }
    }
}
