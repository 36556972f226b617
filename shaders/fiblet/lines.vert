// Uncompressed points of fibres, each fibre a strip of lines: what tractogram viewers do that know no fiblets.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/fiblet/layer_buffers.glsl"
#include "shaders/fiblet/line_end.glsl"

layout(constant_id = 3) const bool kSelection = false;  // fibres have states
layout(constant_id = 4) const bool kTubes = false;      // of selected fibres, which are left out

layout(buffer_reference, scalar) readonly buffer VertexBuffer { FibreVertex at[]; };
layout(push_constant, scalar) uniform Push {
    LayerBuffer layer;
    VertexBuffer vertices;
} push;

layout(location = 0) flat out vec4 from;  // of the segment that begins here
layout(location = 1) flat out vec4 to;
layout(location = 2) flat out uvec2 who;  // and number of segments

void main() {
    const FibletLayerParams layer = push.layer.layer;
    const FibreVertex vertex = push.vertices.at[gl_VertexIndex];
    who = uvec2(vertex.who, 1u);
    from = fibletEyePoint(layer.view, vertex.point);
    to = fibletEyePoint(layer.view, push.vertices.at[gl_VertexIndex + 1].point);
    gl_Position = fibletClip(layer.view, from);
    if (kSelection) {
        const uint state = fibreState(layer, HeadBuffer(layer.heads).at[vertex.who >> FIBLET_SEGMENT_BITS].fibre);
        if (state == FIBRE_HIDDEN || (kTubes && state == FIBRE_SELECTED)) gl_Position = nowhere();
    }
}
