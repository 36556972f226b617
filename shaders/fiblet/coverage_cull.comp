// Lists the fiblets that the coverage buffer does not hide: a fiblet lies within its length of its first point, and of the first of
// the next, so it counts as hidden where one of the two is behind the buffer. One invocation per fiblet.
// Source: Schertzer et al. 2022, Sec. 3.4.1 and 3.4.3.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/common/invocation.glsl"
#include "shaders/fiblet/coverage.glsl"
#include "shaders/common/fiblet_decode.glsl"

layout(constant_id = 1) const float kMargin = 0.0;   // pixels beside a line
layout(constant_id = 2) const bool kCovered = false;  // there is a buffer of a picture before
layout(constant_id = 3) const bool kTubes = false;

bool behindCoverage(FibletCoverageParams coverage, FibletView view, vec4 eye) {
    if (!(eye.w > 1e-5)) return false;
    const vec2 place = (fibletPixel(view, eye) - vec2(view.window_x, view.window_y)) / float(FIBLET_TEXEL);
    if (!(place.x >= 0.0 && place.y >= 0.0 && place.x < float(coverage.columns) && place.y < float(coverage.rows))) return false;
    const uint order = UintBuffer(coverage.moved).at[int(place.y) * coverage.columns + int(place.x)];
    return order != 0u && orderOfDepth(eye.z) > order;
}

void main() {
    const FibletLayerParams layer = push.layer.layer;
    const FibletCoverageParams coverage = push.coverage.params;
    const uint fiblet = push.first + globalInvocation();
    if (fiblet >= layer.fiblet_count) return;
    const FibletView view = layer.view;
    const FibletHead head = HeadBuffer(layer.heads).at[fiblet];
    const vec3 start = fibletStart(head, layer.codec.cell_mm);
    const float reach = float(fibletSegments(head)) * layer.codec.step_mm;
    if (!fibletFootprint(view, start, start, kMargin, reach + (kTubes ? view.tube_radius : 0.0)).seen) return;
    const vec4 eye = fibletEyePoint(view, start);
    if (kCovered) {
        const uint next = UintBuffer(layer.next).at[fiblet];
        if (behindCoverage(coverage, view, eye)) return;
        if (next != FIBLET_NOBODY) {
            const vec3 end = fibletStart(HeadBuffer(layer.heads).at[next], layer.codec.cell_mm);
            if (behindCoverage(coverage, view, fibletEyePoint(view, end))) return;
        }
    }
    UintBuffer(layer.list).at[atomicAdd(CountsBuffer(layer.counts).counts.listed, 1u)] = fiblet;
}
