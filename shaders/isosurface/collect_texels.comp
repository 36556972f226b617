// Lists the texels that pixels need, with what is known of them. One invocation per place of the pool; the order is not defined.
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
    uint places;
    uint capacity;
} push;

void main() {
    const uint place = globalInvocation();
    if (place >= push.places) return;
    const LatticeParams lattice = push.lattice.lattice;
    const uint coverage = wordsAt(lattice.coverage, place, 1u).at[0];
    if (coverage == 0u) return;
    const uint brick = push.bricks.at[place / TEXELS_PER_BRICK], in_brick = place % TEXELS_PER_BRICK;
    const uint row = uint(lattice.brick_size.x), plane = row * uint(lattice.brick_size.y);
    const uvec3 corner = 8u * uvec3(brick % row, (brick % plane) / row, brick / plane);
    const ivec3 texel = ivec3(corner + uvec3(in_brick & 7u, (in_brick >> 3u) & 7u, in_brick >> 6u));
    if (any(greaterThanEqual(texel, lattice.size))) return;
    const uint number = atomicAdd(push.items.count, 1u);
    if (number >= push.capacity) return;
    push.items.at[number] = TexelItem(place, numberOf(lattice, texel), coverage, wordsAt(lattice.state, place, 1u).at[0]);
}
