// Ray against glyph by marching along a polynomial and regula falsi, for comparison with the certified march.
// Source: van Almsick et al. 2011, as Peters et al. 2023, Sec. 2 and 5, describe it. In a frame with its pole towards the camera the ray lies in a
// half plane of constant azimuth, where the function is a polynomial of degree k along the ray (generate/van_almsick.py). The part of the ray
// in the bounding cylinder around the pole is cut into kMarchSteps pieces, and in the first piece whose ends are on different sides of the
// surface regula falsi takes kMarchRefinements steps (both specialisation constants). Any even k, any ray whose azimuth is known.
// Needs van_almsick.py's output for the layout.
#ifndef RADIATA_COMMON_MARCH_VAN_ALMSICK
#define RADIATA_COMMON_MARCH_VAN_ALMSICK
#extension GL_EXT_control_flow_attributes : require
#include "shaders/common/glyph_hit.glsl"
#include "shaders/common/ray_plane.glsl"

// The polynomial along a ray, in s = t - closest and with lengths in units of `unit`: p(s) / r^k is f / unit, r^2 = s^2 + h^2.
struct VanAlmsickRay {
    float p[SH_K + 1];
    float h, closest, unit;
    vec2 span;  // of s, in the cylinder
};

// Where the linear function a + b s is within -limit and limit.
vec2 vanAlmsickSlab(float a, float b, float limit) {
    const float one = (-limit - a) / b, other = (limit - a) / b;
    if (abs(b) < 1e-12) return abs(a) <= limit ? vec2(-1e30, 1e30) : vec2(1.0, -1.0);
    return vec2(min(one, other), max(one, other));
}

// \param g  of the half plane with the pole against the ray's direction: along the pole z = -s, away from it rho = h
VanAlmsickRay vanAlmsickParallel(const float g[SH_K + 1], vec2 cylinder, RayPlane plane) {
    VanAlmsickRay ray;
    ray.unit = max(length(cylinder), 1e-30);
    ray.h = plane.h / ray.unit;
    ray.closest = plane.closest;
    const float reach = plane.h <= cylinder.x ? cylinder.y / ray.unit : -1.0;
    ray.span = vec2(-reach, reach);
    float power = 1.0;
    [[unroll]] for (int i = 0; i <= SH_K; ++i) {
        ray.p[SH_K - i] = i % 2 == 0 ? g[i] * power : -g[i] * power;
        power *= ray.h;
    }
    return ray;
}

// \param g        of the half plane (VAN_ALMSICK_PLANE)
// \param cylinder radius and half length of the bounding cylinder
// \param offset   (cos, sin) of the angle between the near side of the ray and the pole (PoleCircle)
VanAlmsickRay vanAlmsickRay(const float g[SH_K + 1], vec2 cylinder, vec2 offset, RayPlane plane) {
    VanAlmsickRay ray;
    ray.unit = max(length(cylinder), 1e-30);
    ray.h = plane.h / ray.unit;
    ray.closest = plane.closest;
    // Along the pole z = z0 + z1 s, away from it rho = rho0 + rho1 s.
    const float z0 = offset.y * ray.h, z1 = -offset.x, rho0 = offset.x * ray.h, rho1 = offset.y;
    const vec2 along = vanAlmsickSlab(z0, z1, cylinder.y / ray.unit), across = vanAlmsickSlab(rho0, rho1, cylinder.x / ray.unit);
    ray.span = vec2(max(along.x, across.x), min(along.y, across.y));
    float z_power[SH_K + 1];
    z_power[0] = 1.0;
    ray.p[0] = g[SH_K];
    [[unroll]] for (int i = 1; i <= SH_K; ++i) {
        z_power[i] = z_power[i - 1] * z1;
        [[unroll]] for (int j = i - 1; j > 0; --j) z_power[j] = z_power[j] * z0 + z_power[j - 1] * z1;
        z_power[0] *= z0;
        ray.p[i] = ray.p[i - 1] * rho1;
        [[unroll]] for (int j = i - 1; j > 0; --j) ray.p[j] = ray.p[j] * rho0 + ray.p[j - 1] * rho1;
        ray.p[0] *= rho0;
        [[unroll]] for (int j = 0; j <= i; ++j) ray.p[j] += g[SH_K - i] * z_power[j];
    }
    return ray;
}

float vanAlmsickValue(VanAlmsickRay ray, float s) {
    float value = ray.p[SH_K];
    [[unroll]] for (int i = SH_K - 1; i >= 0; --i) value = value * s + ray.p[i];
    return value;
}

// Above 0 inside: |p(s)| - unit r^(k + 1), or p(s) - unit r^(k + 1) for positive lobes only.
float vanAlmsickExcess(VanAlmsickRay ray, float s, bool both_lobes) {
    const float value = vanAlmsickValue(ray, s);
    const float r2 = s * s + ray.h * ray.h;
    float power = ray.unit * sqrt(r2);
    [[unroll]] for (int i = 0; i < SH_K / 2; ++i) power *= r2;
    return (both_lobes ? abs(value) : value) - power;
}

// The same divided by r^k, |f| - r in units of `unit`: nearly linear, so that regula falsi converges, where the excess is flat at the centre.
float vanAlmsickHeight(VanAlmsickRay ray, float s, bool both_lobes) {
    const float value = vanAlmsickValue(ray, s);
    const float r2 = max(s * s + ray.h * ray.h, 1e-12);
    float power = 1.0;
    [[unroll]] for (int i = 0; i < SH_K / 2; ++i) power /= r2;
    return (both_lobes ? abs(value) : value) * power - ray.unit * sqrt(r2);
}

// \param span  first and last ray parameter to search
GlyphHit vanAlmsickFirstHit(VanAlmsickRay ray, vec2 span, bool both_lobes) {
    GlyphHit hit = GlyphHit(0.0, 0.0, 0u);
    const float first = max(ray.span.x, (span.x - ray.closest) / ray.unit), last = min(ray.span.y, (span.y - ray.closest) / ray.unit);
    if (!(first < last)) return hit;
    const float piece = (last - first) / float(kMarchSteps);
    const bool begins_inside = vanAlmsickExcess(ray, first, both_lobes) > 0.0;
    hit.steps = 1u;
    for (uint i = 1u; i <= kMarchSteps; ++i) {
        const float s = first + float(i) * piece;
        const float excess = vanAlmsickExcess(ray, s, both_lobes);
        ++hit.steps;
        if ((excess > 0.0) != begins_inside) {
            float low = s - piece, high = s, root = s;
            float before = vanAlmsickHeight(ray, low, both_lobes);
            float after = vanAlmsickHeight(ray, high, both_lobes);
            for (uint refinement = 0u; refinement < kMarchRefinements; ++refinement) {
                root = clamp(low - before * (high - low) / (after - before), low, high);
                const float value = vanAlmsickHeight(ray, root, both_lobes);
                ++hit.steps;
                const bool on_low_side = (value > 0.0) == begins_inside;
                low = on_low_side ? root : low;
                before = on_low_side ? value : before;
                high = on_low_side ? high : root;
                after = on_low_side ? after : value;
            }
            if (after != before) root = clamp(low - before * (high - low) / (after - before), low, high);
            const float distance = max(ray.unit * sqrt(root * root + ray.h * ray.h), 1e-30);
            hit.t = ray.closest + ray.unit * root;
            hit.amplitude = both_lobes && vanAlmsickValue(ray, root) < 0.0 ? -distance : distance;
            return hit;
        }
    }
    return hit;
}

#endif
