// The light of the scene on a surface, less what glyphs block of it. Rays are those of glyph/visibility.comp, whose bits are read here:
// the light of soft shadows is summed over its unblocked rays, so highlights and half-set lights come out right too.
// Source: Peters and Dachsbacher 2019, Eq. 1 and 2: each ray stands for projected solid angle / number of rays.
#include "shaders/common/brdf.glsl"
#include "shaders/common/illuminated_line.glsl"
#include "shaders/common/projected_cap.glsl"
#include "shaders/common/ray_samples.glsl"

const uint kNoShadow = 0u, kHardShadow = 1u, kSoftShadow = 2u;
layout(constant_id = 20) const uint kShadow = 0u;
layout(constant_id = 21) const bool kOcclusion = false;
layout(constant_id = 22) const uint kShadowRays = 1u;
layout(constant_id = 23) const uint kOcclusionRays = 1u;

layout(buffer_reference, scalar) readonly buffer BitBuffer { uint at[]; };

vec3 softLight(FrameParams frame, vec3 base, float roughness, vec3 normal, vec3 viewer, uint pixel, uint blocked) {
    const ProjectedCap cap = projectedCap(frame.light_direction, normal, frame.light_sine, frame.light_cosine);
    if (!(cap.area > 0.0)) return vec3(0.0);
    vec3 sum = vec3(0.0);
    for (uint i = 0u; i < kShadowRays; ++i) {
        if ((blocked >> i & 1u) != 0u) continue;
        const vec3 light = projectedCapSample(cap, raySample(frame.sample_index * kShadowRays + i, pixel));
        sum += dielectricBrdfCosine(base, roughness, normal, viewer, light) / max(dot(normal, light), 1e-4);
    }
    const float facing = 3.14159265 * cap.sa * cap.sa;  // projected solid angle on a surface that faces the light
    return frame.irradiance * cap.area / (facing * float(kShadowRays)) * sum;
}

// Shares of the light and of the ambient light that reach a pixel, where there is one number for each.
float litShare(BitBuffer shadow_bits, uint pixel) {
    if (kShadow == kHardShadow) return shadow_bits.at[pixel] != 0u ? 0.0 : 1.0;
    if (kShadow == kSoftShadow) return 1.0 - float(bitCount(shadow_bits.at[pixel])) / float(kShadowRays);
    return 1.0;
}
float openShare(BitBuffer occlusion_bits, uint pixel) {
    return kOcclusion ? 1.0 - float(bitCount(occlusion_bits.at[pixel])) / float(kOcclusionRays) : 1.0;
}

// Radiance towards the viewer. \param pixel  number of the pixel
vec3 shadeVisible(FrameParams frame, BitBuffer shadow_bits, BitBuffer occlusion_bits, uint pixel, vec3 base, float roughness,
                  vec3 normal, vec3 viewer) {
    vec3 lit;
    if (kShadow == kSoftShadow) {
        lit = softLight(frame, base, roughness, normal, viewer, pixel, shadow_bits.at[pixel]);
    } else {
        lit = frame.irradiance * dielectricBrdfCosine(base, roughness, normal, viewer, frame.light_direction);
        if (kShadow == kHardShadow && shadow_bits.at[pixel] != 0u) lit = vec3(0.0);
    }
    return lit + frame.ambient * openShare(occlusion_bits, pixel) * base;
}

// The same of a line, whose soft shadows are the share of rays that are blocked. \param tangent  unit
vec3 shadeLine(FrameParams frame, BitBuffer shadow_bits, BitBuffer occlusion_bits, uint pixel, vec3 base, float roughness,
               vec3 tangent, vec3 viewer) {
    const vec3 lit = frame.irradiance * illuminatedLine(base, roughness, tangent, viewer, frame.light_direction);
    return litShare(shadow_bits, pixel) * lit + frame.ambient * openShare(occlusion_bits, pixel) * base;
}
