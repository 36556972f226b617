// Tangents of the points that points.comp has left in the pixels: one invocation per pixel finds the point again by its name.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/common/invocation.glsl"
#include "shaders/fiblet/layer.glsl"
#include "shaders/common/fiblet_decode.glsl"
#include "shaders/common/fibre_directions.glsl"

layout(buffer_reference, scalar) readonly buffer VertexBuffer { FibreVertex at[]; };
layout(push_constant, scalar) uniform Push {
    LayerBuffer layer;
    VertexBuffer vertices;
    UintBuffer first;  // vertex of each fibre
} push;

void main() {
    const FibletLayerParams layer = push.layer.layer;
    const uint at = globalInvocation();
    if (at >= uint(layer.view.width * layer.view.height)) return;
    const uint who = uint(WordBuffer(layer.words).at[at]);
    if (who == FIBLET_NOBODY) return;
    const FibletHead head = HeadBuffer(layer.heads).at[who >> FIBLET_SEGMENT_BITS];
    const uint segment = who & FIBLET_SEGMENTS;
    const uint vertex = push.first.at[head.fibre] + FIBLET_SEGMENTS * fibletIndex(head) + segment;
    const uint direction = packLine(push.vertices.at[vertex + 1u].point - push.vertices.at[vertex].point);
    WordBuffer(layer.tangents).at[at] = uint64_t(direction) << 32 | who;
}
