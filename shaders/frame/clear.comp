// An empty surface buffer, for scenes in which no pass writes all of it: one invocation per pixel.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/frame.glsl"

layout(local_size_x_id = 0) in;
layout(buffer_reference, scalar) writeonly buffer SurfaceBuffer { Surface at[]; };
layout(push_constant, scalar) uniform Push {
    SurfaceBuffer surface;
    uint pixels;
} push;

void main() {
    if (gl_GlobalInvocationID.x >= push.pixels) return;
    push.surface.at[gl_GlobalInvocationID.x] = Surface(uintBitsToFloat(0x7f800000u), 0xffffffffu, vec3(0.0), 0u);
}
