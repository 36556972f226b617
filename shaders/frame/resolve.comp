// The mean of all samples as 8-bit sRGB: one invocation per pixel.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/common/invocation.glsl"
#include "shaders/shared/interop.glsl"
#include "shaders/common/srgb.glsl"

layout(buffer_reference, scalar) readonly buffer LightBuffer { vec3 at[]; };
layout(buffer_reference, scalar) writeonly buffer PictureBuffer { uint rgba[]; };
layout(push_constant, scalar) uniform Push {
    LightBuffer light;
    PictureBuffer picture;
    uint pixels;
    uint samples;
} push;

void main() {
    const uint at = globalInvocation();
    if (at >= push.pixels) return;
    push.picture.rgba[at] = packedColour(srgbFromLinear(push.light.at[at] / float(push.samples)));
}
