// Points of fiblets as decode.comp left them: one instance, a strip of lines, per fiblet.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/fiblet/layer_buffers.glsl"
#include "shaders/fiblet/line_end.glsl"

layout(buffer_reference, scalar) readonly buffer SlotBuffer { FibletSlot at[]; };
layout(push_constant, scalar) uniform Push {
    LayerBuffer layer;
    SlotBuffer slots;
} push;

layout(location = 0) flat out vec4 from;  // of the segment that begins here
layout(location = 1) flat out vec4 to;
layout(location = 2) flat out uint who;

void main() {
    const uint slot = gl_InstanceIndex, segments = push.slots.at[slot].segments;
    // Vertices behind the end stand at the end.
    const uint point = min(gl_VertexIndex, segments);
    from = push.slots.at[slot].eye[point];
    to = push.slots.at[slot].eye[min(point + 1u, segments)];
    who = gl_VertexIndex < segments ? push.slots.at[slot].fiblet << FIBLET_SEGMENT_BITS | point : FIBLET_NOBODY;
    gl_Position = fibletClip(push.layer.layer.view, from);
}
