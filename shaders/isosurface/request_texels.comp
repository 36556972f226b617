// What the visible pixels of a layer interpolate: first the texels that they need, then, once those are there, each texel's coverage, the
// sum of its weights over pixels. One invocation per pixel. Source: Wyman et al. 2006, Sec. 4 (lazy computation).
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/common/invocation.glsl"
#include "shaders/isosurface/hit_point.glsl"
#include "shaders/isosurface/texel_weights.glsl"

layout(constant_id = 2) const bool kMark = false;  // texels, not sum up coverage

layout(buffer_reference, scalar) readonly buffer FrameBuffer { FrameParams frame; };
layout(buffer_reference, scalar) readonly buffer LayerBuffer { IsosurfaceParams layer; };
layout(buffer_reference, scalar) readonly buffer SurfaceBuffer { Surface at[]; };

layout(push_constant, scalar) uniform Push {
    FrameBuffer frame;
    LayerBuffer layer;
    SurfaceBuffer surface;
    LatticeBuffer lattice;
} push;

void main() {
    const FrameParams frame = push.frame.frame;
    const uint pixel = globalInvocation();
    if (pixel >= frame.width * frame.height) return;
    const IsosurfaceParams layer = push.layer.layer;
    const Surface surface = push.surface.at[pixel];
    if (surface.who == 0xffffffffu || (surface.layer_and_steps >> 24u) != layer.layer) return;
    const LatticeParams lattice = push.lattice.lattice;
    const TexelWindow window = texelWindow(lattice, hitPoint(frame, layer, pixel, surface.depth), layer.isovalue);
    for (int i = 0; i < kTexels; ++i) {
        ivec3 texel;
        const float weight = windowTexel(lattice, window, i, texel);
        if (weight <= 0.0) continue;
        const uint brick = brickOf(lattice, texel), in_brick = placeInBrick(texel);
        if (kMark) {
            TexelWords words = TexelWords(lattice.wanted);
            const uint word = 2u * brick + (in_brick >> 5u), bit = 1u << (in_brick & 31u);
            // Most are marked by another pixel already.
            if ((words.at[word] & bit) == 0u) atomicOr(words.at[word], bit);
        } else {
            const uint slot = TexelWords(lattice.index).at[brick];
            if (slot == 0u) continue;  // beyond the budget
            const uint coverage = max(uint(weight * LATTICE_COVERAGE_ONE), 1u);
            atomicAdd(wordsAt(lattice.coverage, (slot - 1u) * TEXELS_PER_BRICK + in_brick, 1u).at[0], coverage);
        }
    }
}
