// Lists the fiblets of some pages that can be seen: one workgroup per page, one invocation per fiblet. A first phase takes those
// that won a pixel of the latest picture; a second, after these were drawn, takes of the others what the depths do not hide. Boxes
// hold all that is drawn, and only what lies strictly behind every pixel it can touch is left out, so the picture is the same
// as without culling, after any camera.
// Source: two phases as in Haar and Aaltonen 2015, with winners of pixels in place of what passed the last test.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/common/invocation.glsl"
#include "shaders/fiblet/layer.glsl"
#include "shaders/fiblet/boxes.glsl"
#include "shaders/fiblet/visible.glsl"
#include "shaders/common/fiblet_places.glsl"

layout(constant_id = 1) const uint kPhase = 0u;  // 0: in the frustum; 1: those seen last; 2: the others, if not hidden; 3: all, if not hidden
layout(constant_id = 2) const float kMargin = 0.0;  // pixels beside a line
layout(constant_id = 3) const bool kTubes = false;
layout(constant_id = 4) const bool kSegments = false;  // fiblets none of whose segments is shown are left out
layout(constant_id = 5) const bool kPaged = false;  // some of the fiblets are on the device; the others are left out

layout(push_constant, scalar) uniform Push {
    LayerBuffer layer;
    UintBuffer pages;  // to look into, by cull_pages.comp
} push;

bool visible(FibletLayerParams layer, vec3 low, vec3 high) {
    return fibletVisible(layer, low, high, kMargin, kTubes ? layer.view.tube_radius : 0.0, kPhase >= 2u);
}

// Whether the depths hide all pieces of a box's diagonal with what is about them; a box alone reaches over many more pixels, and nearer.
bool hiddenAlong(FibletLayerParams layer, FibletBox box, vec3 low, vec3 high) {
    const uint kPieces = 4u;
    vec3 from, to;
    float radius;
    if (!fibletDiagonal(box, low, high, from, to, radius)) return false;
    const float grown = kTubes ? layer.view.tube_radius : 0.0;
    for (uint i = 0u; i < kPieces; ++i) {
        const vec3 a = mix(from, to, float(i) / float(kPieces)), b = mix(from, to, float(i + 1u) / float(kPieces));
        if (fibletVisible(layer, min(a, b) - radius, max(a, b) + radius, kMargin, grown, true)) return false;
    }
    return true;
}

void main() {
    const FibletLayerParams layer = push.layer.layer;
    const uint page = push.pages.at[gl_WorkGroupID.x];
    const FibletPage box = PageBuffer(layer.pages).at[page];
    if (localInvocation() >= box.count) return;
    const uint fiblet = page * FIBLET_PAGE + localInvocation();
    if (kPhase == 1u || kPhase == 2u) {
        const bool seen_last = (UintBuffer(layer.visible).at[fiblet >> 5u] >> (fiblet & 31u) & 1u) != 0u;
        if (seen_last != (kPhase == 1u)) return;
    }
    if (kSegments && WordBuffer(layer.segments).at[fiblet] == 0ul) return;
    uint at = fiblet;
    if (kPaged) {
        const FibletPlace place = PlaceBuffer(layer.places).at[page];
        if (!fibletHeld(place, localInvocation())) return;
        at = fibletHeldAt(place, localInvocation());
    }
    const FibletBox own = BoxBuffer(layer.boxes).at[at];
    vec3 low, high;
    fibletBoxCorners(box, own, low, high);
    if (!visible(layer, low, high) || (kPhase >= 2u && hiddenAlong(layer, own, low, high))) return;
    UintBuffer(layer.list).at[atomicAdd(CountsBuffer(layer.counts).counts.listed, 1u)] = fiblet;
}
