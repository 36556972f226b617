// Lists the pages in which fiblets can be seen, before these are looked at one by one: one invocation per page. See cull.comp.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/common/invocation.glsl"
#include "shaders/fiblet/layer.glsl"
#include "shaders/fiblet/visible.glsl"

layout(constant_id = 1) const uint kPhase = 0u;  // 0: in the frustum; 1: with fiblets seen last; 2, 3: not hidden
layout(constant_id = 2) const float kMargin = 0.0;  // pixels beside a line
layout(constant_id = 3) const bool kTubes = false;

layout(push_constant, scalar) uniform Push {
    LayerBuffer layer;
    UintBuffer found;
    uint first_page;  // in page_order
    uint page_count;
} push;

void main() {
    if (globalInvocation() >= push.page_count) return;
    const FibletLayerParams layer = push.layer.layer;
    const uint page = UintBuffer(layer.page_order).at[push.first_page + globalInvocation()];
    if (kPhase == 1u) {
        // Bits of fiblets past the end are 0.
        const uint first = page * (FIBLET_PAGE / 32u), words = (layer.fiblet_count + 31u) / 32u;
        uint seen_last = 0u;
        for (uint i = first; i < min(first + FIBLET_PAGE / 32u, words); ++i) seen_last |= UintBuffer(layer.visible).at[i];
        if (seen_last == 0u) return;
    }
    const FibletPage box = PageBuffer(layer.pages).at[page];
    if (!fibletVisible(layer, box.low, box.high, kMargin, kTubes ? layer.view.tube_radius : 0.0, kPhase >= 2u)) return;
    push.found.at[atomicAdd(CountsBuffer(layer.counts).counts.pages, 1u)] = page;
}
