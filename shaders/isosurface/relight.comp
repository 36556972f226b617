// Payloads meet the light anew, or another albedo, or other wishes how exact they are to be: one invocation per row of the pool. Nothing is traced.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/common/invocation.glsl"
#include "shaders/isosurface/lattice.glsl"

layout(constant_id = 1) const bool kTransfer = false;
layout(constant_id = 2) const uint kStorage = TEXELS_FLOAT16;

layout(push_constant, scalar) uniform Push {
    LatticeBuffer lattice;
    uint rows;
} push;

void main() {
    const uint row = globalInvocation();
    if (row >= push.rows) return;
    const LatticeParams lattice = push.lattice.lattice;
    const uint place = placeOf(lattice, row);
    if (place == TEXEL_NOWHERE) return;
    const uint state = wordsAt(lattice.state, row, 1u).at[0];
    if ((state & (TEXEL_STAGE_MASK << TEXEL_STAGE_SHIFT)) == 0u) return;
    if ((state & TEXEL_EMPTY) != 0u) {
        TexelPairs(lattice.shown + uint64_t(place) * 8ul).at[0] = uvec2(TEXEL_SHOWN_EMPTY, 0u);
        return;
    }
    TexelWords payload = wordsAt(lattice.payload, row, texelWords(lattice, kStorage));
    const vec3 irradiance = payloadIrradiance(lattice, payload, kTransfer, kStorage);
    TexelPairs shown = TexelPairs(lattice.shown + uint64_t(place) * 8ul);
    shown.at[0] = packShown(irradiance * 0.318309886, shownNormal(shown.at[0]), texelDone(lattice, state));
}
