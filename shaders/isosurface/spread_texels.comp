// States and payloads from rows to places, for bricks that are kept whole from now on: one invocation per row of the pool.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/common/invocation.glsl"
#include "shaders/isosurface/lattice.glsl"

layout(push_constant, scalar) uniform Push {
    LatticeBuffer lattice;
    uint64_t state;    // uint[slots * TEXELS_PER_BRICK]
    uint64_t payload;  // uint[slots * TEXELS_PER_BRICK * words]
    uint rows;
    uint words;
} push;

void main() {
    const uint row = globalInvocation();
    if (row >= push.rows) return;
    const LatticeParams lattice = push.lattice.lattice;
    const uint place = placeOf(lattice, row);
    if (place == TEXEL_NOWHERE) return;
    wordsAt(push.state, place, 1u).at[0] = wordsAt(lattice.state, row, 1u).at[0];
    TexelWords from = wordsAt(lattice.payload, row, push.words), to = wordsAt(push.payload, place, push.words);
    for (uint i = 0u; i < push.words; ++i) to.at[i] = from.at[i];
}
