// Payloads meet the light anew, or another albedo: one invocation per place of the pool. Nothing is traced.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/isosurface/lattice.glsl"

layout(local_size_x_id = 0) in;
layout(constant_id = 1) const bool kTransfer = false;
layout(constant_id = 2) const bool kHalf = true;

layout(push_constant, scalar) uniform Push {
    LatticeBuffer lattice;
    uint places;
} push;

void main() {
    const uint place = gl_GlobalInvocationID.x;
    if (place >= push.places) return;
    const LatticeParams lattice = push.lattice.lattice;
    const uint state = wordsAt(lattice.state, place, 1u).at[0];
    if ((state & (TEXEL_STAGE_MASK << TEXEL_STAGE_SHIFT)) == 0u || (state & TEXEL_EMPTY) != 0u) return;
    const uint words = kHalf ? (lattice.stride + 1u) / 2u : lattice.stride;
    TexelWords payload = wordsAt(lattice.payload, place, words);
    vec3 irradiance;
    if (kTransfer) irradiance = kHalf ? halfTransferred(lattice, payload) : floatTransferred(lattice, payload);
    else irradiance = kHalf ? halfIrradiance(lattice, payload) : floatIrradiance(lattice, payload);
    TexelPairs shown = TexelPairs(lattice.shown + uint64_t(place) * 8ul);
    shown.at[0] = packShown(irradiance * 0.318309886, shownNormal(shown.at[0]));
}
