// Runs the tensor methods over an array of rays against one glyph. Shared values: symmetric components, then the radius of its sphere.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/test/function.glsl"
#include "shaders/test/ray_io.glsl"
#include "shaders/common/range_arithmetic.glsl"
#include "tensor.glsl"
#include "shaders/common/tensor_march.glsl"
#include "shaders/common/tensor_ranges.glsl"

layout(constant_id = 1) const uint kMethod = 0u;  // 0: march, 1: intervals, 2: affine forms
layout(constant_id = 2) const float kStep = 0.01;
layout(constant_id = 3) const uint kBisections = 0u;
layout(constant_id = 4) const bool kInterpolate = true;
layout(constant_id = 5) const bool kAdaptive = false;
layout(constant_id = 6) const uint kDepth = 12u;

FUNCTION_OVER(RayInput, RayOutput)

RayOutput function(RayInput x) {
    const float radius = push.shared_values.value[TENSOR_COUNT];
    float t[TENSOR_COUNT], w[TENSOR_COUNT];
    for (int i = 0; i < TENSOR_COUNT; ++i) t[i] = push.shared_values.value[i];
    tensorWeights(t, 1.0 / radius, w);
    const TensorSettings settings = TensorSettings(kStep, kBisections, kInterpolate, kAdaptive, kDepth);
    const vec3 origin = x.origin / radius;
    const bool both_lobes = x.both_lobes != 0u;
    TensorHit hit;
    if (kMethod == 0u) hit = tensorMarch(w, origin, x.direction, x.t_min / radius, both_lobes, settings);
    else hit = tensorRangeMarch(w, origin, x.direction, x.t_min / radius, both_lobes, settings, kMethod == 2u);
    const vec3 p = origin + hit.t * x.direction;
    return RayOutput(hit.t * radius, hit.value * length(p) * radius, hit.steps, hit.capped ? 1u : 0u,
                     hit.value == 0.0 ? vec3(0.0) : normalize(p));
}

FUNCTION_MAIN
