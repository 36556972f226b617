// What the wrappers of the tensor functions take and give; seen by GLSL and C++.
#ifndef RADIATA_TEST_TENSOR_IO
#define RADIATA_TEST_TENSOR_IO
#include "shaders/shared/interop.glsl"
SHADER_NAMESPACE_BEGIN

struct TensorValue {
    vec3 gradient;
    float value;            // with the gradient
    float alone;            // by tensorEvaluate
    float from_entries;     // by all 3^n entries, orders up to 4; else 0
};
STATIC_SIZE(TensorValue, 24);

struct PieceInput {
    vec3 origin;
    float low;  // s from the ray's closest point
    vec3 direction;
    float high;
};
STATIC_SIZE(PieceInput, 32);

// Ranges of f - |p|^(n + 1) and f + |p|^(n + 1): low, high.
struct PieceOutput {
    vec2 interval_difference, interval_sum;
    vec2 affine_difference, affine_sum;
};
STATIC_SIZE(PieceOutput, 32);

SHADER_NAMESPACE_END
#endif
