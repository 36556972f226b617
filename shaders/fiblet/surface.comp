// What fiblets won, into the surface buffer: one invocation per pixel. Marks the fiblets that are seen, for the next picture's
// first phase, and lists those whose tangents others have overwritten, to be drawn once more (see raster.comp).
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_ballot : require
#include "shaders/common/invocation.glsl"
#include "shaders/fiblet/layer.glsl"
#include "shaders/shared/frame.glsl"
#include "shaders/fiblet/pixel_stretch.glsl"
#include "shaders/common/fibre_directions.glsl"
#include "shaders/common/fiblet_places.glsl"
#include "shaders/fiblet/won.glsl"

layout(constant_id = 1) const bool kFirstLayer = true;
layout(constant_id = 2) const bool kMarks = false;
layout(constant_id = 3) const bool kTubes = false;
layout(constant_id = 4) const bool kSelectedOnly = false;  // of the tubes
layout(constant_id = 5) const bool kMarksOnly = false;     // the surface buffer is left alone
layout(constant_id = 6) const bool kPaged = false;         // some of the fiblets are on the device
#include "shaders/fiblet/shown.glsl"

layout(buffer_reference, scalar) buffer SurfaceBuffer { Surface at[]; };
layout(buffer_reference, scalar) buffer FrameCountersBuffer { uint hit_pixels; };
layout(push_constant, scalar) uniform Push {
    LayerBuffer layer;
    SurfaceBuffer surface;
    FrameCountersBuffer counters;  // null: pixels are resolved once more
} push;

// \return  whether the pixel showed nothing before and now shows this layer
bool resolve(FibletLayerParams layer, uint at, uint64_t word, uint64_t tangent) {
    const uint who = uint(word);
    if (who == FIBLET_NOBODY) {
        if (kFirstLayer && !kMarksOnly) {
            push.surface.at[at].depth = uintBitsToFloat(0x7f800000u);
            push.surface.at[at].who = FIBLET_NOBODY;
            push.surface.at[at].layer_and_steps = 0u;
        }
        return false;
    }
    if (kMarks) markSeen(layer, who);
    if (kMarksOnly) return false;
    const bool empty_before = kFirstLayer || push.surface.at[at].who == FIBLET_NOBODY;
    if (uint(tangent) != who) {
        drawAgain(layer, who);
        return empty_before;
    }
    const uint steps = kFirstLayer ? 0u : push.surface.at[at].layer_and_steps & 0xffffffu;
    const float depth = depthOfOrder(uint(word >> 32)) * pixelStretch(layer.view, at);
    push.surface.at[at] = Surface(depth, who, shownDirection(layer, who, uint(tangent >> 32)), layer.layer << 24u | steps);
    return empty_before;
}

void main() {
    const FibletLayerParams layer = push.layer.layer;
    const uint pixels = uint(layer.view.width * layer.view.height), at = min(globalInvocation(), pixels - 1u);
    // Before all branches, where a CPU driver reads for a fraction of the time.
    const uint64_t word = WordBuffer(layer.words).at[at], tangent = WordBuffer(layer.tangents).at[at];
    const bool hit = globalInvocation() < pixels && resolve(layer, at, word, tangent);
    const uint hits = subgroupBallotBitCount(subgroupBallot(hit && uint64_t(push.counters) != 0ul));
    if (subgroupElect() && hits > 0u) atomicAdd(push.counters.hit_pixels, hits);
}
