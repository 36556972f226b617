// What decode.comp left: one instance, a strip of lines, per fiblet; or a list of lines, two vertices for each.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/fiblet/layer_buffers.glsl"
#include "shaders/fiblet/line_end.glsl"

layout(constant_id = 10) const bool kDetail = false;        // a list, as line_detail.glsl has it
layout(constant_id = 11) const bool kSmallAsLines = false;

layout(buffer_reference, scalar) readonly buffer SlotBuffer { FibletSlot at[]; };
layout(buffer_reference, scalar) readonly buffer LineBuffer { FibletListedLine at[]; };
layout(push_constant, scalar) uniform Push {
    LayerBuffer layer;
    SlotBuffer slots;
} push;

layout(location = 0) flat out vec4 from;  // of the segment that begins here
layout(location = 1) flat out vec4 to;
layout(location = 2) flat out uvec2 who;  // and number of segments

void main() {
    const FibletView view = push.layer.layer.view;
    if (kDetail || kSmallAsLines) {
        const FibletListedLine line = LineBuffer(push.slots).at[gl_VertexIndex >> 1];
        from = line.from;
        to = line.to;
        who = uvec2(line.who, line.count);
        gl_Position = fibletClip(view, (gl_VertexIndex & 1) == 0 ? from : to);
        return;
    }
    const uint slot = gl_InstanceIndex, segments = push.slots.at[slot].segments;
    // Vertices behind the end stand at the end.
    const uint point = min(gl_VertexIndex, segments);
    from = push.slots.at[slot].eye[point];
    to = push.slots.at[slot].eye[min(point + 1u, segments)];
    who = uvec2(gl_VertexIndex < segments ? push.slots.at[slot].fiblet << FIBLET_SEGMENT_BITS | point : FIBLET_NOBODY, 1u);
    gl_Position = fibletClip(view, from);
}
