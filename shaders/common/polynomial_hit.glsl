// Ray against glyph by the real roots of a polynomial, for comparison with the march.
// Source: Peters et al. 2023, Algorithm 1. See polynomial_ray.glsl for the polynomial, polynomial_roots.glsl for how its roots are found.
// Twin: server/reference/glyph_hits.
#ifndef RADIATA_COMMON_POLYNOMIAL_HIT
#define RADIATA_COMMON_POLYNOMIAL_HIT
#include "shaders/common/polynomial_ray.glsl"
#include "shaders/common/polynomial_roots.glsl"

#define POLYNOMIAL_HITS_MAX (POLYNOMIAL_DEGREE * (POLYNOMIAL_ODD + 1))

// The first root in [first, last] that counts. \return whether there is one
bool polynomialFirstRoot(PolynomialRay ray, const POLYNOMIAL_REAL f[POLYNOMIAL_DEGREE + 1], POLYNOMIAL_REAL first, POLYNOMIAL_REAL last,
                         bool both_lobes, out POLYNOMIAL_REAL root, inout uint steps) {
    const POLYNOMIAL_REAL tolerance = kPolynomialTolerance * ray.u_max;
    POLYNOMIAL_REAL extrema[POLYNOMIAL_DEGREE];
    const int count = polynomialExtrema(f, first, last, tolerance, extrema, steps);
    POLYNOMIAL_REAL low = first;
    bool low_positive = polynomialValue(f, POLYNOMIAL_DEGREE, first) > 0.0;
    for (int i = 0; i <= count; ++i) {
        const POLYNOMIAL_REAL high = i < count ? extrema[i] : last;
        const bool high_positive = polynomialValue(f, POLYNOMIAL_DEGREE, high) > 0.0;
        if (high_positive != low_positive) {
            root = polynomialBracketedRoot(f, POLYNOMIAL_DEGREE, low, high, low_positive, tolerance, steps);
            if (POLYNOMIAL_ODD != 0 || both_lobes || polynomialAmplitude(ray, root) > 0.0) return true;
        }
        low = high;
        low_positive = high_positive;
    }
    root = 0.0;
    return false;
}

// First hit with t >= t_min.
// \param o  ray origin relative to the glyph's centre, in units of amplitude; \param d  unit
GlyphHit polynomialFirstHit(vec3 o, vec3 d, float t_min, bool both_lobes) {
    GlyphHit hit = GlyphHit(0.0, 0.0, 0u);
    const PolynomialRay ray = polynomialRay(o, d);
    const POLYNOMIAL_REAL first = max(-ray.u_max, (t_min - ray.closest) / ray.h);
    POLYNOMIAL_REAL last = ray.u_max;
    if (!(first < last)) return hit;
    const int polynomials = POLYNOMIAL_ODD != 0 && both_lobes ? 2 : 1;
    for (int i = 0; i < polynomials; ++i) {
        const POLYNOMIAL_REAL lobe = i == 0 ? 1.0 : -1.0;
        POLYNOMIAL_REAL f[POLYNOMIAL_DEGREE + 1], u;
        polynomialCoefficients(ray, lobe, f);
        if (polynomialFirstRoot(ray, f, first, last, both_lobes, u, hit.steps)) {
            const POLYNOMIAL_REAL amplitude = POLYNOMIAL_ODD != 0 ? lobe * ray.h * sqrt(1.0 + u * u) : polynomialAmplitude(ray, u);
            hit.t = float(ray.closest + u * ray.h);
            hit.amplitude = float(amplitude);
            last = u;  // the other lobes count only in front of this one
        }
    }
    return hit;
}

// All hits of the whole line with both lobes, ascending: t, signed amplitude, and 1 where the ray enters the glyph or 0 where it leaves.
// \return their number
int polynomialAllHits(vec3 o, vec3 d, out vec3 hits[POLYNOMIAL_HITS_MAX], inout uint steps) {
    const PolynomialRay ray = polynomialRay(o, d);
    if (ray.u_max < 0.0) return 0;
    const POLYNOMIAL_REAL tolerance = kPolynomialTolerance * ray.u_max;
    int found = 0;
    for (int polynomial = 0; polynomial <= POLYNOMIAL_ODD; ++polynomial) {
        const POLYNOMIAL_REAL lobe = polynomial == 0 ? 1.0 : -1.0;
        POLYNOMIAL_REAL f[POLYNOMIAL_DEGREE + 1], extrema[POLYNOMIAL_DEGREE];
        polynomialCoefficients(ray, lobe, f);
        const int count = polynomialExtrema(f, -ray.u_max, ray.u_max, tolerance, extrema, steps);
        POLYNOMIAL_REAL low = -ray.u_max;
        bool low_positive = polynomialValue(f, POLYNOMIAL_DEGREE, low) > 0.0;
        for (int i = 0; i <= count; ++i) {
            const POLYNOMIAL_REAL high = i < count ? extrema[i] : ray.u_max;
            const bool high_positive = polynomialValue(f, POLYNOMIAL_DEGREE, high) > 0.0;
            if (high_positive != low_positive && found < POLYNOMIAL_HITS_MAX) {
                const POLYNOMIAL_REAL u = polynomialBracketedRoot(f, POLYNOMIAL_DEGREE, low, high, low_positive, tolerance, steps);
                const float at = float(ray.closest + u * ray.h);
                const float amplitude =
                    float(POLYNOMIAL_ODD != 0 ? lobe * ray.h * sqrt(1.0 + u * u) : polynomialAmplitude(ray, u));
                // Of two polynomials, the second one's hits are sorted in. Both are positive inside.
                int place = found++;
                for (; place > 0 && hits[place - 1].x > at; --place) hits[place] = hits[place - 1];
                hits[place] = vec3(at, amplitude, high_positive ? 1.0 : 0.0);
            }
            low = high;
            low_positive = high_positive;
        }
    }
    return found;
}

#endif
