// Lights texels of the illumination lattice: one invocation per texel follows the paths of one more stage for each of four replicates
// and stores their mean, as wide as the lattice keeps it, with its relative standard error.
// Sums are kept in float32 from stage to stage.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/common/invocation.glsl"
#include "shaders/isosurface/light_paths.glsl"

layout(constant_id = 1) const bool kTransfer = false;
layout(constant_id = 2) const uint kStorage = TEXELS_FLOAT16;

// coverage: the texel's row of sums; state: paths of each replicate that its sums have, and afterwards its new state.
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer ItemBuffer { TexelItem at[]; };

layout(push_constant, scalar) uniform Push {
    LatticeBuffer lattice;
    ItemBuffer items;
    TexelFloats sums;     // per row: stride numbers over all replicates, and each replicate's luminance
    uint first_item;
    uint item_end;
    uint first_path;      // of each replicate; texels that have more begin where they are
    uint path_end;
    uint stage_end;       // of the whole stage, of which this dispatch may be a part
    uint seed;
} push;

void main() {
    const uint item_number = push.first_item + globalInvocation();
    if (item_number >= push.item_end) return;
    const LatticeParams lattice = push.lattice.lattice;
    const TexelItem item = push.items.at[item_number];
    const uint row = lattice.stride + LATTICE_REPLICATES;
    TexelFloats sums = TexelFloats(uint64_t(push.sums) + uint64_t(item.coverage) * uint64_t(4u * row));
    TexelWords state = wordsAt(lattice.state, item.row, 1u);
    SurfacePoint point;
    if (!texelSurface(lattice, texelOf(lattice, item.texel), point)) {
        state.at[0] = TEXEL_EMPTY | (TEXEL_STAGE_MASK << TEXEL_STAGE_SHIFT);
        TexelPairs(lattice.shown + uint64_t(placeOf(lattice, item.row)) * 8ul).at[0] = uvec2(TEXEL_SHOWN_EMPTY, 0u);
        push.items.at[item_number].state = state.at[0];
        return;
    }
    const uint first_path = max(push.first_path, item.state);
    if (first_path >= push.path_end) return;
    if (first_path == 0u) {
        for (uint i = 0u; i < row; ++i) sums.at[i] = 0.0;
    }
    const uint texel_seed = childSeed(push.seed, item.texel);
    PathLight light;
    for (uint k = 0u; k <= kBouncesMax; ++k) light.irradiance[k] = vec3(0.0);
    for (uint replicate = 0u; replicate < LATTICE_REPLICATES; ++replicate) {
        const uint seed = childSeed(texel_seed, replicate);
        float bright = 0.0;
        for (uint path = first_path; path < push.path_end; ++path) {
            const PathLight found = followPath(lattice, point, kTransfer, path, seed, sums);
            vec3 weight = vec3(1.0);
            for (uint k = 0u; k <= lattice.bounces; ++k) {
                light.irradiance[k] += found.irradiance[k];
                bright += luminance(weight * found.irradiance[k]);
                weight *= lattice.albedo;
            }
        }
        sums.at[lattice.stride + replicate] += bright;
    }
    if (!kTransfer) {
        for (uint k = 0u; k <= lattice.bounces; ++k) {
            for (uint c = 0u; c < 3u; ++c) sums.at[3u * k + c] += light.irradiance[k][c];
        }
    }

    if (push.path_end != push.stage_end) {
        push.items.at[item_number].state = push.path_end;
        return;
    }
    // Means over all paths so far.
    const float scale = 1.0 / float(LATTICE_REPLICATES * push.path_end), replicate_scale = 1.0 / float(push.path_end);
    float mean = 0.0, squares = 0.0;
    for (uint i = 0u; i < LATTICE_REPLICATES; ++i) mean += 0.25 * replicate_scale * sums.at[lattice.stride + i];
    for (uint i = 0u; i < LATTICE_REPLICATES; ++i) {
        const float off = replicate_scale * sums.at[lattice.stride + i] - mean;
        squares += off * off;
    }
    const float relative = sqrt(squares / 12.0) / max(mean, lattice.irradiance_floor);
    TexelWords payload = wordsAt(lattice.payload, item.row, texelWords(lattice, kStorage));
    if (kStorage == TEXELS_RGB8) {
        vec3 sum = vec3(0.0), weight = vec3(scale);
        for (uint k = 0u; k <= lattice.bounces; ++k) {
            sum += weight * vec3(sums.at[3u * k], sums.at[3u * k + 1u], sums.at[3u * k + 2u]);
            weight *= lattice.albedo;
        }
        payload.at[0] = packRgb8(lattice, sum);
    } else for (uint i = 0u; i < lattice.stride; ++i) {
        const float value = scale * sums.at[i];
        if (kStorage == TEXELS_FLOAT32) payload.at[i] = floatBitsToUint(value);
        else if ((i & 1u) == 1u) payload.at[i >> 1u] = packHalf2x16(clamp(vec2(scale * sums.at[i - 1u], value), -65000.0, 65000.0));
        else if (i + 1u == lattice.stride) payload.at[i >> 1u] = packHalf2x16(clamp(vec2(value, 0.0), -65000.0, 65000.0));
    }
    const vec3 irradiance = payloadIrradiance(lattice, payload, kTransfer, kStorage);
    const uint stage = uint(findMSB(LATTICE_REPLICATES * push.path_end)) + 1u;
    const uint known = (packHalf2x16(vec2(min(relative, 60000.0), 0.0)) & 0xffffu) | (stage << TEXEL_STAGE_SHIFT);
    TexelPairs(lattice.shown + uint64_t(placeOf(lattice, item.row)) * 8ul).at[0] = packShown(irradiance / kPi, point.normal, texelDone(lattice, known));
    state.at[0] = known;
    push.items.at[item_number].state = known;
}
