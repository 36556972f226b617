// Squares numbers; what the tests of the device layer run.
#version 460
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require

#extension GL_GOOGLE_include_directive : require
#include "shaders/common/invocation.glsl"

layout(buffer_reference, scalar) buffer Numbers { float value[]; };
layout(push_constant, scalar) uniform Push {
    Numbers numbers;
    uint count;
} push;

void main() {
    const uint i = globalInvocation();
    if (i < push.count) push.numbers.value[i] *= push.numbers.value[i];
}
