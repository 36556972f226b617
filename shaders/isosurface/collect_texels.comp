// Lists the texels that pixels need, with what is known of them. One invocation per row of the pool; the order is not defined.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/common/invocation.glsl"
#include "shaders/isosurface/lattice.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer ItemList {
    uint count;
    TexelItem at[];
};
layout(push_constant, scalar) uniform Push {
    LatticeBuffer lattice;
    ItemList items;
    TexelWords bricks;  // of each slot: its brick's number
    uint rows;
    uint capacity;
} push;

void main() {
    const uint texel_row = globalInvocation();
    if (texel_row >= push.rows) return;
    const LatticeParams lattice = push.lattice.lattice;
    const uint place = placeOf(lattice, texel_row);
    if (place == TEXEL_NOWHERE) return;
    const uint coverage = wordsAt(lattice.coverage, place, 1u).at[0];
    if (coverage == 0u) return;
    const uint brick = push.bricks.at[place / TEXELS_PER_BRICK], in_brick = place % TEXELS_PER_BRICK;
    const uint row = uint(lattice.brick_size.x), plane = row * uint(lattice.brick_size.y);
    const uvec3 corner = TEXEL_BRICK_EDGE * uvec3(brick % row, (brick % plane) / row, brick / plane);
    const uvec3 in_row = uvec3(in_brick, in_brick >> TEXEL_BRICK_SHIFT, in_brick >> (2 * TEXEL_BRICK_SHIFT));
    const ivec3 texel = ivec3(corner + (in_row & (TEXEL_BRICK_EDGE - 1u)));
    if (any(greaterThanEqual(texel, lattice.size))) return;
    const uint number = atomicAdd(push.items.count, 1u);
    if (number >= push.capacity) return;
    push.items.at[number] = TexelItem(texel_row, numberOf(lattice, texel), coverage, wordsAt(lattice.state, texel_row, 1u).at[0]);
}
