// Words of pixels before a layer's fiblets are drawn: the depth of what earlier layers show there, and nobody. Where there are none,
// the words are filled with ones without a pass: no depth has as high an order. Of a transparent layer, the same in all slots of
// the chains; where nothing is left to compose, or nothing of it is seen, the least of words, before which nothing comes.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/common/invocation.glsl"
#include "shaders/fiblet/layer.glsl"
#include "shaders/shared/frame.glsl"
#include "shaders/fiblet/pixel_stretch.glsl"

layout(constant_id = 2) const uint kChain = 0u;  // slots of each pixel of a transparent layer; 0: it is opaque
#include "shaders/fiblet/chain.glsl"

layout(constant_id = 1) const bool kCounting = false;  // segments before what is opaque will be counted
layout(constant_id = 3) const bool kPeeling = false;   // something is composed

layout(buffer_reference, scalar) readonly buffer SurfaceBuffer { Surface at[]; };
layout(buffer_reference, scalar) readonly buffer VeilBuffer { vec4 at[]; };
layout(push_constant, scalar) uniform Push {
    LayerBuffer layer;
    SurfaceBuffer surface;  // of what is opaque
    VeilBuffer veil;        // radiance, transmittance; not read without kPeeling
} push;

// Less than half a step of 8 bits of sRGB where these are smallest, 1 / (2 * 255 * 12.92).
const float kNothing = 1.0 / 8192.0;

// Whether the chain that was drawn last holds all that is left, and all of it is composed.
bool isEmptied(FibletLayerParams layer, uint at, uint pixels) {
    const uint64_t composed = WordBuffer(layer.peeled).at[at];
    bool left = false;
    uint who = 0u;
    for (uint i = at; i < kChain * pixels; i += pixels) {
        const uint64_t word = ChainBuffer(layer.chain).at[i].word;
        who = uint(word);
        left = left || (who != FIBLET_NOBODY && word > composed);
    }
    return who == FIBLET_NOBODY && !left;
}

void main() {
    const FibletLayerParams layer = push.layer.layer;
    // Before all branches, where a CPU driver reads for a fraction of the time.
    const uint pixels = uint(layer.view.width * layer.view.height), at = min(globalInvocation(), pixels - 1u);
    uint64_t word = uint64_t(orderOfDepth(push.surface.at[at].depth / pixelStretch(layer.view, at))) << 32 | FIBLET_NOBODY;
    if (kPeeling && (push.veil.at[at].a <= kNothing || isEmptied(layer, at, pixels))) word = uint64_t(FIBLET_NOBODY);
    if (globalInvocation() >= pixels) return;
    WordBuffer(layer.words).at[at] = word;
    if (kChain == 0u) return;
    for (uint i = at; i < kChain * pixels; i += pixels) ChainBuffer(layer.chain).at[i] = ChainSlot(word, kUnnamed);
    LimitBuffer(layer.limits).at[at] = uint(word >> 32);
    if (kCounting) {
        WordBuffer(layer.peeled).at[at] = word;
        UintBuffer(layer.fragments).at[at] = 0u;
    }
}
