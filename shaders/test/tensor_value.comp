// Value and gradient of a tensor over an array of points. Shared values: symmetric components, then all entries for orders up to 4.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/test/function.glsl"
#include "shaders/test/tensor_io.glsl"
#include "shaders/common/range_arithmetic.glsl"
#include "tensor.glsl"

FUNCTION_OVER(vec3, TensorValue)

TensorValue function(vec3 p) {
    float t[TENSOR_COUNT], w[TENSOR_COUNT];
    for (int i = 0; i < TENSOR_COUNT; ++i) t[i] = push.shared_values.value[i];
    tensorWeights(t, 1.0, w);
    const vec4 slope = tensorEvaluateGradient(w, p);
    TensorValue result = TensorValue(slope.xyz, slope.w, tensorEvaluate(w, p), 0.0);
#ifdef TENSOR_ENTRIES
    float entries[TENSOR_ENTRIES];
    for (int i = 0; i < TENSOR_ENTRIES; ++i) entries[i] = push.shared_values.value[TENSOR_COUNT + i];
    result.from_entries = tensorEvaluateEntries(entries, p);
#endif
    return result;
}

FUNCTION_MAIN
