// Directions of a pixel's secondary rays, whatever they are tested against: towards the light's centre (hard shadow), towards a
// spherical light (soft) or to everywhere above the surface (ambient occlusion).
// The includer defines kRays (kHardRays, ...) and kRayCount, and has FrameParams.
#ifndef RADIATA_COMMON_SECONDARY_RAYS
#define RADIATA_COMMON_SECONDARY_RAYS
#include "shaders/common/cosine_hemisphere.glsl"
#include "shaders/common/projected_cap.glsl"
#include "shaders/common/ray_samples.glsl"

vec3 directions[kRayCount];

// Fills directions; \return bits of those that need a test
uint makeRays(FrameParams frame, vec3 normal, uint at) {
    if (kRays == kHardRays) {
        directions[0] = frame.light_direction;
        return dot(normal, frame.light_direction) > 0.0 ? 1u : 0u;
    }
    ProjectedCap cap;
    if (kRays == kSoftRays) {
        cap = projectedCap(frame.light_direction, normal, frame.light_sine, frame.light_cosine);
        if (!(cap.area > 0.0)) return 0u;
    }
    for (uint i = 0u; i < kRayCount; ++i) {
        const vec2 u = raySample(frame.sample_index * kRayCount + i, at);
        directions[i] = kRays == kSoftRays ? projectedCapSample(cap, u) : cosineHemisphereSample(normal, u);
    }
    return 0xffffffffu >> (32u - kRayCount);
}

#endif
