// Light of the visible pixels of a layer, interpolated between texels: radiance of a white diffuse surface. One invocation per pixel.
// Texels without light yet, and those without a surface, leave their share to the others; where none has any the light is -1, and the
// light pass lights the pixel locally. Texels that were lit on the shown surface count by how their normals agree with the pixel's.
// Source: Wyman et al. 2006, Sec. 4.2.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/common/invocation.glsl"
#include "shaders/isosurface/hit_point.glsl"
#include "shaders/isosurface/texel_weights.glsl"

layout(constant_id = 2) const bool kSettled = false;  // texels must be as exact as a picture at rest wants them

layout(buffer_reference, scalar) readonly buffer FrameBuffer { FrameParams frame; };
layout(buffer_reference, scalar) readonly buffer LayerBuffer { IsosurfaceParams layer; };
layout(buffer_reference, scalar) readonly buffer SurfaceBuffer { Surface at[]; };
layout(buffer_reference, scalar) writeonly buffer GlobalLightBuffer { vec3 at[]; };

layout(push_constant, scalar) uniform Push {
    FrameBuffer frame;
    LayerBuffer layer;
    SurfaceBuffer surface;
    LatticeBuffer lattice;
    GlobalLightBuffer light;
    TexelWords lacking;    // set to 1 if some pixel needs a texel that is not there, or not as exact as a picture at rest wants it
    float relative_error;  // that it wants
    uint samples_max;
    uint samples_least;
} push;

bool isDone(uint state) {
    const uint samples = 1u << (((state >> TEXEL_STAGE_SHIFT) & TEXEL_STAGE_MASK) - 1u);
    return samples >= push.samples_max || (samples >= push.samples_least && unpackHalf2x16(state).x <= push.relative_error);
}

void main() {
    const FrameParams frame = push.frame.frame;
    const uint pixel = globalInvocation();
    if (pixel >= frame.width * frame.height) return;
    const IsosurfaceParams layer = push.layer.layer;
    const Surface surface = push.surface.at[pixel];
    if (surface.who == 0xffffffffu || (surface.layer_and_steps >> 24u) != layer.layer) return;
    const LatticeParams lattice = push.lattice.lattice;
    const GridPoint point = hitPoint(frame, layer, pixel, surface.depth);
    const TexelWindow window = texelWindow(lattice, point, layer.isovalue);
    const vec3 normal = lattice.projected != 0u ? outwardNormal(lattice.volume, point) : vec3(0.0);
    vec3 sum = vec3(0.0);
    float total = 0.0;
    bool lacking = false;
    uint brick = 0xffffffffu, slot = 0u;  // of the texel before
    for (int i = 0; i < kTexels; ++i) {
        ivec3 texel;
        float weight = windowTexel(lattice, window, i, texel);
        if (weight <= 0.0) continue;
        const uint wanted = brickOf(lattice, texel);
        if (wanted != brick) {
            brick = wanted;
            slot = TexelWords(lattice.index).at[brick];
        }
        lacking = lacking || slot == 0u;
        if (slot == 0u) continue;
        const uint place = (slot - 1u) * TEXELS_PER_BRICK + placeInBrick(texel);
        const uvec2 shown = TexelPairs(lattice.shown + uint64_t(place) * 8ul).at[0];
        if ((shown.y & TEXEL_SHOWN_LIT) == 0u) {
            lacking = lacking || (shown.x & TEXEL_SHOWN_EMPTY) == 0u;
            continue;
        }
        if (kSettled) lacking = lacking || !isDone(wordsAt(lattice.state, place, 1u).at[0]);
        if (lattice.projected != 0u) {
            const float agreement = max(dot(normal, shownNormal(shown)), 0.0);
            weight *= agreement * agreement + 1e-3;
        }
        sum += weight * shownRadiance(shown);
        total += weight;
    }
    if (lacking) push.lacking.at[0] = 1u;
    push.light.at[pixel] = total > 0.0 ? sum / total : vec3(-1.0);
}
