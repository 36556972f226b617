// Ray against glyph by all complex roots of the polynomial, as Peters et al. 2023, Sec. 3.5 tried it for k = 4 (2.7 times slower than bracketed
// Newton bisection there).
// Source: Laguerre's method with deflation and polishing, Press et al., Numerical Recipes, 3rd edition, Sec. 9.5.3 (laguer, zroots); rewritten.
// A root u counts as real if its imaginary part is at most kLaguerreReal max(1, |u|) (a specialisation constant): double roots, at silhouettes,
// are known to about the square root of float32's rounding. Needs the same as polynomial_ray.glsl, even bands.
#ifndef RADIATA_COMMON_LAGUERRE_HIT
#define RADIATA_COMMON_LAGUERRE_HIT
#include "shaders/common/polynomial_ray.glsl"

const uint kLaguerreStepLimit = 80u;
const uint kLaguerrePeriod = 10u;  // every so many steps one of another length, which breaks cycles
const float kLaguerreRounding = 1.2e-7;
const float kLaguerreFractions[9] = float[](0.0, 0.5, 0.25, 0.75, 0.13, 0.38, 0.62, 0.88, 1.0);

vec2 complexProduct(vec2 a, vec2 b) { return vec2(a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x); }

// By the larger part of the divisor, so that nothing overflows (Smith 1962).
vec2 complexQuotient(vec2 a, vec2 b) {
    const bool real = abs(b.x) >= abs(b.y);
    const float ratio = real ? b.y / b.x : b.x / b.y;
    const float scale = real ? b.x + b.y * ratio : b.x * ratio + b.y;
    return (real ? vec2(a.x + a.y * ratio, a.y - a.x * ratio) : vec2(a.x * ratio + a.y, a.y * ratio - a.x)) / scale;
}

// The root with a real part that is not negative.
vec2 complexRoot(vec2 z) {
    const float larger = max(abs(z.x), abs(z.y));
    if (!(larger > 0.0)) return vec2(0.0);
    const float size = larger * length(z / larger);
    const float part = sqrt(0.5 * (size + abs(z.x)));
    const float other = z.y / (2.0 * part);
    return z.x >= 0.0 ? vec2(part, other) : vec2(abs(other), z.y < 0.0 ? -part : part);
}

// From `x` to a root of the polynomial a[0] + .. + a[degree] x^degree.
vec2 laguerreRoot(const vec2 a[POLYNOMIAL_DEGREE + 1], int degree, vec2 x, inout uint steps) {
    const float m = float(degree);
    for (uint step = 1u; step <= kLaguerreStepLimit; ++step) {
        ++steps;
        vec2 b = a[degree], d = vec2(0.0), f = vec2(0.0);
        float error = length(b);
        const float size = length(x);
        for (int j = degree - 1; j >= 0; --j) {
            f = complexProduct(x, f) + d;
            d = complexProduct(x, d) + b;
            b = complexProduct(x, b) + a[j];
            error = length(b) + size * error;
        }
        if (!(length(b) > kLaguerreRounding * error)) return x;
        const vec2 g = complexQuotient(d, b), g2 = complexProduct(g, g);
        const vec2 h = g2 - 2.0 * complexQuotient(f, b);
        const vec2 root = complexRoot((m - 1.0) * (m * h - g2));
        const vec2 plus = g + root, minus = g - root;
        const vec2 larger = dot(plus, plus) < dot(minus, minus) ? minus : plus;
        const vec2 move = dot(larger, larger) > 0.0 ? complexQuotient(vec2(m, 0.0), larger)
                                                    : (1.0 + size) * vec2(cos(float(step)), sin(float(step)));
        const vec2 next = x - move;
        if (next == x) return x;
        x = step % kLaguerrePeriod != 0u ? next : x - kLaguerreFractions[step / kLaguerrePeriod] * move;
    }
    return x;
}

// All roots of the real polynomial f, polished on it.
void laguerreRoots(const float f[POLYNOMIAL_DEGREE + 1], out vec2 roots[POLYNOMIAL_DEGREE], inout uint steps) {
    vec2 whole[POLYNOMIAL_DEGREE + 1], deflated[POLYNOMIAL_DEGREE + 1];
    for (int i = 0; i <= POLYNOMIAL_DEGREE; ++i) whole[i] = deflated[i] = vec2(f[i], 0.0);
    for (int j = POLYNOMIAL_DEGREE - 1; j >= 0; --j) {
        vec2 x = laguerreRoot(deflated, j + 1, vec2(0.0), steps);
        if (abs(x.y) <= 2.0 * kLaguerreRounding * abs(x.x)) x.y = 0.0;
        roots[j] = x;
        vec2 b = deflated[j + 1];
        for (int i = j; i >= 0; --i) {
            const vec2 c = deflated[i];
            deflated[i] = b;
            b = complexProduct(x, b) + c;
        }
    }
    for (int j = 0; j < POLYNOMIAL_DEGREE; ++j) roots[j] = laguerreRoot(whole, POLYNOMIAL_DEGREE, roots[j], steps);
}

// First hit with t >= t_min. \param o  ray origin relative to the glyph's centre, in units of amplitude; \param d  unit
GlyphHit laguerreFirstHit(vec3 o, vec3 d, float t_min, bool both_lobes) {
    GlyphHit hit = GlyphHit(0.0, 0.0, 0u);
    const PolynomialRay ray = polynomialRay(o, d);
    if (ray.u_max < 0.0) return hit;
    float f[POLYNOMIAL_DEGREE + 1];
    polynomialCoefficients(ray, 1.0, f);
    vec2 roots[POLYNOMIAL_DEGREE];
    laguerreRoots(f, roots, hit.steps);
    float nearest = ray.u_max;
    const float first = max(-ray.u_max, (t_min - ray.closest) / ray.h);
    for (int i = 0; i < POLYNOMIAL_DEGREE; ++i) {
        const float u = roots[i].x;
        if (!(u >= first && u <= nearest) || abs(roots[i].y) > kLaguerreReal * max(1.0, abs(u))) continue;
        const float amplitude = polynomialAmplitude(ray, u);
        if (!both_lobes && amplitude < 0.0) continue;
        nearest = u;
        hit.t = ray.closest + u * ray.h;
        hit.amplitude = amplitude;
    }
    return hit;
}

// All hits of the whole line with both lobes, ascending: t, signed amplitude, and 1 where the ray enters the glyph or 0 where it leaves.
// \return their number
int laguerreAllHits(vec3 o, vec3 d, out vec3 hits[POLYNOMIAL_DEGREE], inout uint steps) {
    const PolynomialRay ray = polynomialRay(o, d);
    if (ray.u_max < 0.0) return 0;
    float f[POLYNOMIAL_DEGREE + 1];
    polynomialCoefficients(ray, 1.0, f);
    vec2 roots[POLYNOMIAL_DEGREE];
    laguerreRoots(f, roots, steps);
    int found = 0;
    for (int i = 0; i < POLYNOMIAL_DEGREE; ++i) {
        const float u = roots[i].x;
        if (!(abs(u) <= ray.u_max) || abs(roots[i].y) > kLaguerreReal * max(1.0, abs(u))) continue;
        // The polynomial is positive inside.
        float value = f[POLYNOMIAL_DEGREE], slope = 0.0;
        for (int j = POLYNOMIAL_DEGREE - 1; j >= 0; --j) {
            slope = slope * u + value;
            value = value * u + f[j];
        }
        const vec3 hit = vec3(ray.closest + u * ray.h, polynomialAmplitude(ray, u), slope > 0.0 ? 1.0 : 0.0);
        int place = found++;
        for (; place > 0 && hits[place - 1].x > hit.x; --place) hits[place] = hits[place - 1];
        hits[place] = hit;
    }
    return found;
}

#endif
