// Runs fiblet_decode.glsl: the point of a fiblet by its number, in mm from the set's origin. The shared values are the words of the FibletCodec, then
// all codes.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/test/function.glsl"
#include "shaders/test/fiblet_io.glsl"
#include "shaders/common/fiblet_decode.glsl"

FUNCTION_OVER(FibletPointInput, vec3)

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer CodecBuffer { FibletCodec codec; };

vec3 function(FibletPointInput x) {
    const FibletCodec codec = CodecBuffer(uint64_t(push.shared_values)).codec;
    FibletCodes codes = FibletCodes(uint64_t(push.shared_values) + 72ul);
    const uint width = fibletWidth(x.head);
    FibletPen pen = fibletBegin(x.head, codec);
    for (uint i = 1; i <= x.point; ++i) {
        if (i > 1) fibletTurn(pen, fibletCode(codes, x.first_word, i - 2, width), width, codec.cap_ratio[fibletCap(x.head)]);
        fibletMove(pen, fibletLength(x.head, codes, x.first_word, i, codec.step_mm));
    }
    return pen.point;
}

FUNCTION_MAIN
