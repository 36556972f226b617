// First hit of a ray with the Reynolds glyph of a Cartesian tensor by steps of fixed length, as its authors draw it.
// Source: Hlawitschka et al., Sec. 3.1 and 4: the surface |f(p)| = |p|^(n + 1), a test against the bounding sphere, a change of sign between
// samples, bisection and one linear interpolation, and steps of a third near the centre.
// Note: the paper's footnote ends in f(p) - |p|^n; with the radius as the function's value it is f(p) - |p|^(n + 1), as in its Eq. 4 and 5.
// Its f without absolute value has positive lobes only; both lobes take |f|. How near "near the centre" is, it does not say: kTensorNear.
// All lengths in radii of the bounding sphere: the paper's [-1, 1]^3. Needs tensor.py's output for the order.
// Misses what lies between two samples; that is what the method is shown for.
#ifndef RADIATA_COMMON_TENSOR_MARCH
#define RADIATA_COMMON_TENSOR_MARCH
#include "shaders/common/ray_plane.glsl"

const float kTensorNear = 0.25;

struct TensorSettings {
    float step;        // 0.01, 0.02, 0.05 in the paper
    uint bisections;   // 0 to 3 in the paper
    bool interpolate;  // one linear interpolation at the end; else the middle of the bracket
    bool adaptive;     // steps of a third within kTensorNear of the centre
    uint depth;        // of ranges: pieces of the ray are halved so many times
};

struct TensorHit {
    float t;      // ray parameter
    float value;  // sign of f there; 0: no hit
    uint steps;   // evaluations of f, or of its range
    bool capped;
};

// Points of the ray by their distance s from the ray's closest point to the centre: exact near the centre.
struct TensorRay {
    vec3 foot;
    vec3 direction;
    float height;   // |foot|
    float closest;  // ray parameter of the foot
    float begin, end;  // s of the part within the bounding sphere; begin > end: none
};

TensorRay tensorRay(vec3 o, vec3 d, float t_min) {
    const RayPlane plane = rayPlane(o, d);
    TensorRay ray = TensorRay(plane.h * plane.e, d, plane.h, plane.closest, 1.0, 0.0);
    if (plane.h >= 1.0) return ray;
    ray.end = sqrt((1.0 - plane.h) * (1.0 + plane.h));
    ray.begin = max(-ray.end, t_min - plane.closest);
    return ray;
}

vec3 tensorPoint(TensorRay ray, float s) { return ray.foot + s * ray.direction; }

// |p|^(n + 1)
float tensorRadiusPower(float square) {
    float power = (TENSOR_ORDER & 1) == 0 ? sqrt(square) : 1.0;
    for (int i = 0; i < (TENSOR_ORDER + 1) / 2; ++i) power *= square;
    return power;
}

// Positive inside.
float tensorInside(const float w[TENSOR_COUNT], vec3 p, bool both_lobes) {
    const float f = tensorEvaluate(w, p);
    return (both_lobes ? abs(f) : f) - tensorRadiusPower(dot(p, p));
}

// The zero between a and b, where the values have different signs.
float tensorRefine(const float w[TENSOR_COUNT], TensorRay ray, float a, float b, float value_a, float value_b, bool both_lobes,
                   TensorSettings settings, inout uint steps) {
    for (uint i = 0u; i < settings.bisections; ++i) {
        const float middle = 0.5 * (a + b);
        const float value = tensorInside(w, tensorPoint(ray, middle), both_lobes);
        ++steps;
        if ((value > 0.0) == (value_a > 0.0)) {
            a = middle;
            value_a = value;
        } else {
            b = middle;
            value_b = value;
        }
    }
    return settings.interpolate ? a - value_a * (b - a) / (value_b - value_a) : 0.5 * (a + b);
}

TensorHit tensorHit(const float w[TENSOR_COUNT], TensorRay ray, float s, uint steps) {
    const float f = tensorEvaluate(w, tensorPoint(ray, s));
    return TensorHit(ray.closest + s, f < 0.0 ? -1.0 : 1.0, steps, false);
}

// \param o  ray origin relative to the centre, in radii of the sphere that holds the glyph; \param d  unit
// \param w  weights of the tensor in the same unit
TensorHit tensorMarch(const float w[TENSOR_COUNT], vec3 o, vec3 d, float t_min, bool both_lobes, TensorSettings settings) {
    const TensorRay ray = tensorRay(o, d, t_min);
    uint steps = 0u;
    float a = ray.begin;
    float value_a = a < ray.end ? tensorInside(w, tensorPoint(ray, a), both_lobes) : 0.0;
    while (a < ray.end) {
        const bool near = settings.adaptive && ray.height * ray.height + a * a < kTensorNear * kTensorNear;
        const float b = min(a + (near ? settings.step * (1.0 / 3.0) : settings.step), ray.end);
        const float value_b = tensorInside(w, tensorPoint(ray, b), both_lobes);
        ++steps;
        if ((value_a > 0.0) != (value_b > 0.0)) {
            const float s = tensorRefine(w, ray, a, b, value_a, value_b, both_lobes, settings, steps);
            return tensorHit(w, ray, s, steps);
        }
        a = b;
        value_a = value_b;
    }
    return TensorHit(0.0, 0.0, steps, false);
}

#endif
