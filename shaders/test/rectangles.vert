// Rectangles for the tests of the rasteriser: corners 0 to 3 of instance i, from a buffer.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/interop.glsl"

struct Rectangle {
    vec2 low;  // of clip space
    vec2 high;
    float depth;
    uint word;
};
layout(buffer_reference, scalar) readonly buffer RectangleBuffer { Rectangle at[]; };
layout(push_constant, scalar) uniform Push { RectangleBuffer rectangles; } push;

layout(location = 0) flat out uint word;

void main() {
    const Rectangle shape = push.rectangles.at[gl_InstanceIndex];
    const bvec2 upper = bvec2((gl_VertexIndex & 1) != 0, (gl_VertexIndex & 2) != 0);
    gl_Position = vec4(mix(shape.low, shape.high, upper), shape.depth, 1.0);
    word = shape.word;
}
