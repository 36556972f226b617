// Ray against glyph by the roots of a polynomial of degree 2k + 2, for comparison with the march.
// Source: Peters et al. 2023, Algorithm 1, Eq. 5 to 10. In the frame (d, e) of the ray's plane, scaled so that the ray is v = 1, the hits
// are the roots u of  g(u, 1)^2 - h^2 (u^2 + 1)^(k + 1).
// Note: the bound in the printed Algorithm 1 is garbled; see generate/polynomial.py. A ray through the centre, for which e is undefined in
// the paper, is moved off it by kPolynomialNearest of the bound. Even k only.
// The includer provides polynomial.py's output for its k, kPolynomialStopOnBracket (see polynomial_roots.glsl) and, before including,
//   float shEvaluate(vec3 direction);
#ifndef RADIATA_COMMON_POLYNOMIAL_HIT
#define RADIATA_COMMON_POLYNOMIAL_HIT
#include "shaders/common/polynomial_roots.glsl"
#include "shaders/common/ray_plane.glsl"

const float kPolynomialTolerance = 2e-4;  // times u_max
const float kPolynomialNearest = 1e-6;

struct GlyphHit {
    float t;
    float amplitude;  // signed f in the direction of the hit; 0: no hit
    uint steps;       // Newton steps over all derivatives
};

struct PolynomialRay {
    float h, closest;
    float u_max;  // roots lie in [-u_max, u_max]; negative: there are none
    float g[POLYNOMIAL_K + 1];
    float f[POLYNOMIAL_DEGREE + 1];
};

PolynomialRay polynomialRay(vec3 o, vec3 d) {
    PolynomialRay ray;
    const RayPlane plane = rayPlane(o, d);
    ray.closest = plane.closest;
    float samples[POLYNOMIAL_K + 1];
    for (int l = 0; l <= POLYNOMIAL_K; ++l) samples[l] = shEvaluate(kPolynomialCos[l] * d + kPolynomialSin[l] * plane.e);
    float g_max = 0.0;
    [[unroll]] for (int i = 0; i <= POLYNOMIAL_K; ++i) {
        float sum = 0.0;
        [[unroll]] for (int l = 0; l <= POLYNOMIAL_K; ++l) sum += kPolynomialInverse[i * (POLYNOMIAL_K + 1) + l] * samples[l];
        ray.g[i] = sum;
        g_max += abs(sum) * kPolynomialBound[i];
    }
    ray.h = max(plane.h, kPolynomialNearest * g_max);
    ray.u_max = -1.0;
    if (!(ray.h < g_max)) return ray;
    const float ratio = g_max / ray.h;
    ray.u_max = sqrt((ratio - 1.0) * (ratio + 1.0));
    const float h2 = ray.h * ray.h;
    [[unroll]] for (int i = 0; i <= POLYNOMIAL_DEGREE; ++i) {
        float sum = i % 2 == 0 ? -h2 * kPolynomialBinomial[i / 2] : 0.0;
        [[unroll]] for (int j = max(0, i - POLYNOMIAL_K); j <= min(i, POLYNOMIAL_K); ++j) {
            if (j < i - j) sum += 2.0 * ray.g[j] * ray.g[i - j];
            if (j == i - j) sum += ray.g[j] * ray.g[j];
        }
        ray.f[i] = sum;
    }
    return ray;
}

float polynomialAmplitude(PolynomialRay ray, float u) {
    float g = ray.g[POLYNOMIAL_K];
    [[unroll]] for (int i = POLYNOMIAL_K - 1; i >= 0; --i) g = g * u + ray.g[i];
    const float radius = ray.h * sqrt(1.0 + u * u);
    return g < 0.0 ? -radius : radius;
}

// First hit with t >= t_min.
// \param o  ray origin relative to the glyph's centre, in units of amplitude; \param d  unit
GlyphHit polynomialFirstHit(vec3 o, vec3 d, float t_min, bool both_lobes) {
    GlyphHit hit = GlyphHit(0.0, 0.0, 0u);
    const PolynomialRay ray = polynomialRay(o, d);
    const float first = max(-ray.u_max, (t_min - ray.closest) / ray.h);
    const float last = ray.u_max;
    if (!(first < last)) return hit;
    const float tolerance = kPolynomialTolerance * ray.u_max;
    float extrema[POLYNOMIAL_DEGREE];
    const int count = polynomialExtrema(ray.f, first, last, tolerance, extrema, hit.steps);
    float low = first;
    bool low_positive = polynomialValue(ray.f, POLYNOMIAL_DEGREE, first) > 0.0;
    for (int i = 0; i <= count; ++i) {
        const float high = i < count ? extrema[i] : last;
        const bool high_positive = polynomialValue(ray.f, POLYNOMIAL_DEGREE, high) > 0.0;
        if (high_positive != low_positive) {
            const float u =
                polynomialBracketedRoot(ray.f, POLYNOMIAL_DEGREE, low, high, low_positive, tolerance, hit.steps);
            const float amplitude = polynomialAmplitude(ray, u);
            if (both_lobes || amplitude > 0.0) {
                hit.t = ray.closest + u * ray.h;
                hit.amplitude = amplitude;
                break;
            }
        }
        low = high;
        low_positive = high_positive;
    }
    return hit;
}

// All hits of the whole line with both lobes, ascending. \return their number
int polynomialAllHits(vec3 o, vec3 d, out float t[POLYNOMIAL_DEGREE]) {
    const PolynomialRay ray = polynomialRay(o, d);
    if (ray.u_max < 0.0) return 0;
    const float tolerance = kPolynomialTolerance * ray.u_max;
    uint steps = 0u;
    float extrema[POLYNOMIAL_DEGREE];
    const int count = polynomialExtrema(ray.f, -ray.u_max, ray.u_max, tolerance, extrema, steps);
    int found = 0;
    float low = -ray.u_max;
    bool low_positive = polynomialValue(ray.f, POLYNOMIAL_DEGREE, low) > 0.0;
    for (int i = 0; i <= count; ++i) {
        const float high = i < count ? extrema[i] : ray.u_max;
        const bool high_positive = polynomialValue(ray.f, POLYNOMIAL_DEGREE, high) > 0.0;
        if (high_positive != low_positive) {
            const float u = polynomialBracketedRoot(ray.f, POLYNOMIAL_DEGREE, low, high, low_positive, tolerance, steps);
            t[found++] = ray.closest + u * ray.h;
        }
        low = high;
        low_positive = high_positive;
    }
    return found;
}

#endif
