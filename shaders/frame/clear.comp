// An empty surface buffer, for scenes in which no pass writes all of it: one invocation per pixel.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/common/invocation.glsl"
#include "shaders/shared/frame.glsl"

layout(buffer_reference, scalar) writeonly buffer SurfaceBuffer { Surface at[]; };
layout(push_constant, scalar) uniform Push {
    SurfaceBuffer surface;
    uint pixels;
} push;

void main() {
    if (globalInvocation() >= push.pixels) return;
    push.surface.at[globalInvocation()] = Surface(uintBitsToFloat(0x7f800000u), 0xffffffffu, vec3(0.0), 0u);
}
