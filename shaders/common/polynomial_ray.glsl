// The polynomial whose roots are the hits of a ray with a glyph.
// Source: Peters et al. 2023, Sec. 3.2 to 3.4, Eq. 5 to 10. In the frame (d, e) of the ray's plane, scaled so that the ray is v = 1, the hits
// are the roots u of
//   g(u, 1)^2 - h^2 (u^2 + 1)^(k + 1)             functions of even bands
//   lobe g(u, 1) - h (u^2 + 1)^((k + 1) / 2)      functions of odd bands, one polynomial for each sign (footnote of Sec. 3.1)
// Note: the bound in the printed Algorithm 1 is garbled; see generate/polynomial.py. A ray through the centre, for which e is undefined in
// the paper, is moved off it by kPolynomialNearest of the bound.
// The includer provides polynomial.py's output for its layout and, before including,
//   float shEvaluate(vec3 direction);              or, with POLYNOMIAL_DOUBLE,  double shEvaluate(dvec3 direction);
#ifndef RADIATA_COMMON_POLYNOMIAL_RAY
#define RADIATA_COMMON_POLYNOMIAL_RAY
#extension GL_EXT_control_flow_attributes : require
#include "shaders/common/glyph_hit.glsl"
#include "shaders/common/ray_plane.glsl"

#ifdef POLYNOMIAL_DOUBLE
#define POLYNOMIAL_VEC3 dvec3
const double kPolynomialNearest = 1e-10;
#else
#define POLYNOMIAL_VEC3 vec3
const float kPolynomialNearest = 1e-6;
#endif

struct PolynomialRay {
    POLYNOMIAL_REAL h, closest;
    POLYNOMIAL_REAL u_max;  // roots lie in [-u_max, u_max]; negative: there are none
    POLYNOMIAL_REAL g[POLYNOMIAL_K + 1];
};

// \param o  ray origin relative to the glyph's centre, in units of amplitude; \param d  unit
PolynomialRay polynomialRay(vec3 o, vec3 d) {
    PolynomialRay ray;
#ifdef POLYNOMIAL_DOUBLE
    const dvec3 along = normalize(dvec3(d));
    const dvec3 foot = dvec3(o) - dot(dvec3(o), along) * along;
    const double h = length(foot);
    const dvec3 aside = dvec3(anyOrthogonal(d));
    const dvec3 e = h > 0.0 ? foot / h : normalize(aside - dot(aside, along) * along);
    ray.closest = -dot(dvec3(o), along);
#else
    const RayPlane plane = rayPlane(o, d);
    const vec3 along = d, e = plane.e;
    const float h = plane.h;
    ray.closest = plane.closest;
#endif
    POLYNOMIAL_REAL samples[POLYNOMIAL_K + 1];
    for (int l = 0; l <= POLYNOMIAL_K; ++l) samples[l] = shEvaluate(kPolynomialCos[l] * along + kPolynomialSin[l] * e);
    POLYNOMIAL_REAL g_max = 0.0;
    [[unroll]] for (int i = 0; i <= POLYNOMIAL_K; ++i) {
        POLYNOMIAL_REAL sum = 0.0;
        [[unroll]] for (int l = 0; l <= POLYNOMIAL_K; ++l) sum += kPolynomialInverse[i * (POLYNOMIAL_K + 1) + l] * samples[l];
        ray.g[i] = sum;
        g_max += abs(sum) * kPolynomialBound[i];
    }
    ray.h = max(h, kPolynomialNearest * g_max);
    ray.u_max = -1.0;
    if (!(ray.h < g_max)) return ray;
    const POLYNOMIAL_REAL ratio = g_max / ray.h;
    ray.u_max = sqrt((ratio - 1.0) * (ratio + 1.0));
    return ray;
}

// \param lobe  1 or -1: which sign's hits are the roots (odd bands; for even bands all hits are)
void polynomialCoefficients(PolynomialRay ray, POLYNOMIAL_REAL lobe, out POLYNOMIAL_REAL f[POLYNOMIAL_DEGREE + 1]) {
#if POLYNOMIAL_ODD
    [[unroll]] for (int i = 0; i <= POLYNOMIAL_DEGREE; ++i) {
        f[i] = (i % 2 == 0 ? -ray.h * kPolynomialBinomial[i / 2] : 0.0) + (i <= POLYNOMIAL_K ? lobe * ray.g[min(i, POLYNOMIAL_K)] : 0.0);
    }
#else
    const POLYNOMIAL_REAL h2 = ray.h * ray.h;
    [[unroll]] for (int i = 0; i <= POLYNOMIAL_DEGREE; ++i) {
        POLYNOMIAL_REAL sum = i % 2 == 0 ? -h2 * kPolynomialBinomial[i / 2] : 0.0;
        [[unroll]] for (int j = max(0, i - POLYNOMIAL_K); j <= min(i, POLYNOMIAL_K); ++j) {
            if (j < i - j) sum += 2.0 * ray.g[j] * ray.g[i - j];
            if (j == i - j) sum += ray.g[j] * ray.g[j];
        }
        f[i] = sum;
    }
#endif
}

// Signed f in the direction of the hit.
POLYNOMIAL_REAL polynomialAmplitude(PolynomialRay ray, POLYNOMIAL_REAL u) {
    POLYNOMIAL_REAL g = ray.g[POLYNOMIAL_K];
    [[unroll]] for (int i = POLYNOMIAL_K - 1; i >= 0; --i) g = g * u + ray.g[i];
    const POLYNOMIAL_REAL radius = ray.h * sqrt(1.0 + u * u);
    return g < 0.0 ? -radius : radius;
}

#endif
