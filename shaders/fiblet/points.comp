// Uncompressed points of fibres as points: one invocation each, which puts a square of the line's width around it into the words. In
// close-ups there are gaps. Source: Schuetz et al. 2021, which Schertzer et al. 2022, Table 3, compare with.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/common/invocation.glsl"
#include "shaders/fiblet/layer.glsl"

layout(constant_id = 1) const uint kCuts = 0u;
layout(constant_id = 2) const bool kSelection = false;  // fibres have states
layout(constant_id = 3) const bool kTubes = false;      // of selected fibres, which are left out

layout(constant_id = 4) const bool kSegments = false;   // some segments are left out

layout(buffer_reference, scalar) readonly buffer VertexBuffer { FibreVertex at[]; };
layout(push_constant, scalar) uniform Push {
    LayerBuffer layer;
    VertexBuffer vertices;
    uint first;
    uint count;
} push;

void main() {
    if (globalInvocation() >= push.count) return;
    const FibletLayerParams layer = push.layer.layer;
    const FibletView view = layer.view;
    const FibreVertex vertex = push.vertices.at[push.first + globalInvocation()];
    const vec4 eye = fibletEyePoint(view, vertex.point);
    if (!(eye.z >= view.near_depth && eye.z <= view.far_depth)) return;
    const vec2 window = fibletPixel(view, eye) - vec2(view.window_x, view.window_y);
    const int width = int(view.line_width);
    const vec2 corner = floor(window - 0.5 * float(width - 1));
    if (!(corner.x > -64.0 && corner.y > -64.0 && corner.x < float(view.width) && corner.y < float(view.height))) return;
    if (kSelection) {
        const uint state = fibreState(layer, HeadBuffer(layer.heads).at[vertex.who >> FIBLET_SEGMENT_BITS].fibre);
        if (state == FIBRE_HIDDEN || (kTubes && state == FIBRE_SELECTED)) return;
    }
    if (kSegments) {
        const uint64_t shown = WordBuffer(layer.segments).at[vertex.who >> FIBLET_SEGMENT_BITS];
        if ((shown >> (vertex.who & FIBLET_SEGMENTS) & 1ul) == 0ul) return;
    }
    for (uint i = 0u; i < kCuts; ++i) {
        if (dot(layer.cuts[i].normal, vertex.point) > layer.cuts[i].offset) return;
    }
    const uint64_t word = uint64_t(orderOfDepth(eye.z)) << 32 | vertex.who;
    WordBuffer words = WordBuffer(layer.words);
    for (int y = max(int(corner.y), 0); y < min(int(corner.y) + width, view.height); ++y) {
        for (int x = max(int(corner.x), 0); x < min(int(corner.x) + width, view.width); ++x) {
            const uint pixel = uint(y * view.width + x);
            if (word < words.at[pixel]) atomicMin(words.at[pixel], word);
        }
    }
}
