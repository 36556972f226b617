// Hits by the polynomial of Peters et al. 2023: by bracketed Newton bisection in float32 or, with POLYNOMIAL_DOUBLE, in double
// (METHOD_POLYNOMIAL; even bands, or with a full layout odd bands), or by Laguerre's method (METHOD_LAGUERRE).
#include "polynomial.glsl"
#ifdef METHOD_LAGUERRE
layout(constant_id = 9) const float kLaguerreReal = 1e-3;
#else
layout(constant_id = 9) const bool kPolynomialStopOnBracket = false;
layout(constant_id = 10) const float kPolynomialTolerance = 2e-4;
#endif

#ifdef POLYNOMIAL_DOUBLE
double shEvaluate(dvec3 direction) { return shEvaluateDouble(glyph_coefficients, direction).x; }
#else
float shEvaluate(vec3 direction) {
    const vec2 parts = shEvaluate(glyph_coefficients, direction);
    return POLYNOMIAL_ODD != 0 ? parts.y : parts.x;
}
#endif

#ifdef METHOD_LAGUERRE
#include "shaders/common/laguerre_hit.glsl"
#else
#include "shaders/common/polynomial_hit.glsl"
#endif

void intersectInstance(FrameParams frame, GlyphLayerParams layer, uint index, GlyphInstance instance, vec3 centre) {
    loadCoefficients(layer.coefficients, layer.stride, instance.slot);
    const float unit = 1.0 / instance.scale;
    const vec3 origin = (ray.origin - centre) * unit;
#ifdef METHOD_LAGUERRE
    const GlyphHit hit = laguerreFirstHit(origin, ray.direction, ray.near * unit, kBothLobes);
#else
    const GlyphHit hit = polynomialFirstHit(origin, ray.direction, ray.near * unit, kBothLobes);
#endif
    keepNearest(index, instance.scale, hit, origin);
}
