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
layout(constant_id = 3) const bool kProjected = false;  // they are lit on the shown surface

layout(buffer_reference, scalar) readonly buffer FrameBuffer { FrameParams frame; };
layout(buffer_reference, scalar) readonly buffer LayerBuffer { IsosurfaceParams layer; };
layout(buffer_reference, scalar) readonly buffer SurfaceBuffer { Surface at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer TexelLights { uint64_t at[]; };
layout(buffer_reference, scalar) writeonly buffer GlobalLightBuffer { vec3 at[]; };

layout(push_constant, scalar) uniform Push {
    FrameBuffer frame;
    LayerBuffer layer;
    SurfaceBuffer surface;
    LatticeBuffer lattice;
    GlobalLightBuffer light;
    TexelWords lacking;    // set to 1 if some pixel needs a texel that is not there, or not as exact as a picture at rest wants it
} push;

// Outward as texels' normals are: the surface buffer's normal faces the viewer instead.
vec3 outward(VolumeParams volume, GridPoint point, vec3 normal) {
    float c[8];
    cellCorners(volume, point.cell, 0.0, c);
    return dot(worldGradient(volume, cellGradient(c, clamp(point.at, 0.0, 1.0))), normal) > 0.0 ? -normal : normal;
}

void main() {
    // What all pixels read comes before the first branch: a CPU driver reads it once for all lanes there, else for each.
    const FrameParams frame = push.frame.frame;
    const IsosurfaceParams layer = push.layer.layer;
    const LatticeParams lattice = push.lattice.lattice;
    const uint pixel = globalInvocation();
    if (pixel >= frame.width * frame.height) return;
    if (push.surface.at[pixel].who == 0xffffffffu || (push.surface.at[pixel].layer_and_steps >> 24u) != layer.layer) return;
    const GridPoint point = hitPoint(frame, layer, pixel, push.surface.at[pixel].depth);
    const TexelWindow window = texelWindow(lattice, point, layer.isovalue);
    const vec3 normal = kProjected ? outward(lattice.volume, point, push.surface.at[pixel].normal) : vec3(0.0);
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
        const uvec2 shown = unpackUint2x32(TexelLights(lattice.shown + uint64_t(place) * 8ul).at[0]);  // in one load
        if ((shown.y & TEXEL_SHOWN_LIT) == 0u) {
            lacking = lacking || (shown.x & TEXEL_SHOWN_EMPTY) == 0u;
            continue;
        }
        if (kSettled) lacking = lacking || (shown.x & TEXEL_SHOWN_DONE) == 0u;
        if (kProjected) {
            // The other side of a fold has another light altogether: the eighth power of the cosine.
            const float agreement = max(dot(normal, shownNormal(shown)), 0.0), squared = agreement * agreement;
            weight *= squared * squared * squared * squared + 1e-3;
        }
        sum += weight * shownRadiance(shown);
        total += weight;
    }
    if (lacking) push.lacking.at[0] = 1u;
    push.light.at[pixel] = total > 0.0 ? sum / total : vec3(-1.0);
}
