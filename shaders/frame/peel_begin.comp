// Before each round of peeling: nothing is found yet but the nearest glyphs that are not composed, in front of what is opaque.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/common/invocation.glsl"
#include "shaders/shared/frame.glsl"
#include "shaders/shared/layer_look.glsl"
#include "shaders/shared/peel.glsl"

layout(constant_id = 1) const bool kFirstRound = true;
layout(constant_id = 2) const uint kGlyphs = 0u;     // bit i: layer i has transparent glyphs
layout(constant_id = 3) const uint kSurfaces = 0u;   // bit i: it is a transparent isosurface
layout(constant_id = 4) const bool kCounting = false;  // the first round of a moving picture

layout(buffer_reference, scalar) buffer PeelBuffer { PeelParams peel; };
layout(buffer_reference, scalar) buffer SurfaceBuffer { Surface at[]; };
layout(buffer_reference, scalar) writeonly buffer FloatBuffer { float at[]; };
layout(buffer_reference, scalar) readonly buffer LookBuffer { LayerLook at[]; };

layout(push_constant, scalar) uniform Push {
    PeelBuffer peel;
    SurfaceBuffer opaque, found;
    LookBuffer looks;
    uint pixels;
} push;

void main() {
    const uint at = globalInvocation();
    if (at >= push.pixels) return;
    const float infinite = uintBitsToFloat(0x7f800000u);
    Surface nearest = Surface(infinite, 0xffffffffu, vec3(0.0), 0u);
    float through = 1.0;
    for (uint i = 0u; i < 8u; ++i) {
        if (kFirstRound && (kSurfaces >> i & 1u) != 0u) FloatBuffer(push.peel.peel.crossings[i]).at[at] = -infinite;
        if ((kGlyphs >> i & 1u) == 0u) continue;
        const Surface own = SurfaceBuffer(push.peel.peel.glyphs[i]).at[at];
        if (own.who == 0xffffffffu || own.depth >= push.opaque.at[at].depth) continue;
        through *= 1.0 - push.looks.at[i].opacity;
        if (own.depth < nearest.depth) nearest = own;
    }
    push.found.at[at] = nearest;
    if (kCounting) FloatBuffer(push.peel.peel.rest).at[at] = through;
}
