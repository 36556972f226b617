// Of a transparent layer, the nearest segment that is not composed yet into the peel surface, from the pixel's chain, where no other
// layer has found something nearer. One invocation per pixel.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/common/invocation.glsl"
#include "shaders/fiblet/layer.glsl"
#include "shaders/shared/frame.glsl"
#include "shaders/fiblet/pixel_stretch.glsl"
#include "shaders/common/fibre_directions.glsl"
#include "shaders/common/fiblet_places.glsl"
#include "shaders/fiblet/won.glsl"

layout(constant_id = 1) const bool kAlone = true;  // no other layer is transparent
layout(constant_id = 2) const uint kChain = 1u;    // slots of a pixel
layout(constant_id = 3) const bool kNew = true;    // chains were drawn just now: nothing of them is composed
layout(constant_id = 4) const bool kTubes = false;
layout(constant_id = 5) const bool kSelectedOnly = false;  // of the tubes
layout(constant_id = 7) const bool kPaged = false;         // some of the fiblets are on the device
#include "shaders/fiblet/chain.glsl"
#include "shaders/fiblet/shown.glsl"

layout(buffer_reference, scalar) buffer SurfaceBuffer { Surface at[]; };
layout(push_constant, scalar) uniform Push {
    LayerBuffer layer;
    SurfaceBuffer surface;
    uint slot;  // with kAlone, as many segments of the chain are composed
} push;

// The least of words first. Who has a direction that is another's is drawn again; nobody has that of nobody.
void sortChain(FibletLayerParams layer, uint at, uint pixels) {
    ChainSlot kept[kChain];
    for (uint i = 0u; i < kChain; ++i) {
        kept[i] = ChainBuffer(layer.chain).at[at + i * pixels];
        if (uint(kept[i].word) != uint(kept[i].named)) drawAgain(layer, uint(kept[i].word));
    }
    for (uint sorted = 1u; sorted < kChain; ++sorted) {
        for (uint i = 0u; i < kChain - sorted; ++i) {
            const ChainSlot a = kept[i], b = kept[i + 1u];
            const bool swaps = b.word < a.word;
            kept[i] = ChainSlot(swaps ? b.word : a.word, swaps ? b.named : a.named);
            kept[i + 1u] = ChainSlot(swaps ? a.word : b.word, swaps ? a.named : b.named);
        }
    }
    for (uint i = 0u; i < kChain; ++i) ChainBuffer(layer.chain).at[at + i * pixels] = kept[i];
}

void main() {
    const FibletLayerParams layer = push.layer.layer;
    // Before all branches, where a CPU driver reads for a fraction of the time.
    const uint pixels = uint(layer.view.width * layer.view.height), at = min(globalInvocation(), pixels - 1u);
    if (kNew && globalInvocation() < pixels) sortChain(layer, at, pixels);
    uint slot = at + push.slot * pixels;
    if (!kAlone && !kNew) {
        const uint64_t composed = WordBuffer(layer.peeled).at[at];
        // One segment at most was taken for each time that this was run, so some are left, or nobody stands in the last slot.
        while (slot + pixels < kChain * pixels && ChainBuffer(layer.chain).at[slot].word <= composed) slot += pixels;
    }
    const ChainSlot found = ChainBuffer(layer.chain).at[slot];
    const uint who = uint(found.word);
    if (globalInvocation() >= pixels) return;
    if (who == FIBLET_NOBODY) {
        if (kAlone) push.surface.at[at] = Surface(uintBitsToFloat(0x7f800000u), FIBLET_NOBODY, vec3(0.0), 0u);
        return;
    }
    const float depth = depthOfOrder(uint(found.word >> 32)) * pixelStretch(layer.view, at);
    if (!kAlone && depth > push.surface.at[at].depth) return;
    WordBuffer(layer.words).at[at] = found.word;
    WordBuffer(layer.tangents).at[at] = found.named;
    push.surface.at[at] = Surface(depth, who, shownDirection(layer, who, uint(found.named >> 32)), layer.layer << 24u);
}
