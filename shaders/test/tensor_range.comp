// Ranges of a tensor's implicit function over pieces of rays. Shared values: symmetric components.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/test/function.glsl"
#include "shaders/test/tensor_io.glsl"
#include "shaders/common/range_arithmetic.glsl"
#include "tensor.glsl"
#include "shaders/common/tensor_march.glsl"
#include "shaders/common/tensor_ranges.glsl"

FUNCTION_OVER(PieceInput, PieceOutput)

PieceOutput function(PieceInput x) {
    float t[TENSOR_COUNT], w[TENSOR_COUNT];
    for (int i = 0; i < TENSOR_COUNT; ++i) t[i] = push.shared_values.value[i];
    tensorWeights(t, 1.0, w);
    const TensorRay ray = tensorRay(x.origin, x.direction, -2.0);
    const TensorPiece interval = tensorIntervalPiece(w, ray, x.low, x.high);
    const TensorPiece affine = tensorAffinePiece(w, ray, x.low, x.high);
    return PieceOutput(vec2(interval.difference.low, interval.difference.high), vec2(interval.sum.low, interval.sum.high),
                       vec2(affine.difference.low, affine.difference.high), vec2(affine.sum.low, affine.sum.high));
}

FUNCTION_MAIN
