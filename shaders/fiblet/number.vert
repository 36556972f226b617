// The numbers of fiblets, for the geometry and tessellation shaders that decode them: one vertex per fiblet.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/fiblet/layer_buffers.glsl"

layout(constant_id = 1) const bool kListed = false;  // fiblets of the list; else all in their order

layout(push_constant, scalar) uniform Push { LayerBuffer layer; } push;

layout(location = 0) out uint fiblet;

void main() {
    fiblet = kListed ? UintBuffer(push.layer.layer.list).at[gl_VertexIndex] : gl_VertexIndex;
    gl_Position = vec4(0.0, 0.0, 0.0, 1.0);
}
