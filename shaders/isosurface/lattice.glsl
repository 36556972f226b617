// Where texels are, and what they keep. See shaders/shared/lattice.glsl.
#ifndef RADIATA_ISOSURFACE_LATTICE
#define RADIATA_ISOSURFACE_LATTICE
#include "shaders/common/octahedral.glsl"
#include "shaders/common/sh_values.glsl"
#include "shaders/shared/lattice.glsl"

layout(buffer_reference, scalar) readonly buffer LatticeBuffer { LatticeParams lattice; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer TexelWords { uint at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer TexelFloats { float at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 8) buffer TexelPairs { uvec2 at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer LightHarmonics { vec3 at[]; };

// Pools may be larger than 4 GiB: addresses are made in 64 bits.
TexelWords wordsAt(uint64_t pool, uint number, uint words) { return TexelWords(pool + uint64_t(number) * uint64_t(4u * words)); }

uint brickOf(LatticeParams lattice, ivec3 texel) {
    const ivec3 brick = texel >> int(TEXEL_BRICK_SHIFT);
    return uint(brick.x + lattice.brick_size.x * (brick.y + lattice.brick_size.y * brick.z));
}
uint placeInBrick(ivec3 texel) {
    const ivec3 at = texel & int(TEXEL_BRICK_EDGE - 1u);
    return uint(at.x | (at.y << TEXEL_BRICK_SHIFT) | (at.z << (2 * TEXEL_BRICK_SHIFT)));
}
uint placeOf(LatticeParams lattice, uint row) { return lattice.places == 0ul ? row : TexelWords(lattice.places).at[row]; }
uint numberOf(LatticeParams lattice, ivec3 texel) {
    return uint(texel.x) + uint(lattice.size.x) * (uint(texel.y) + uint(lattice.size.y) * uint(texel.z));
}
ivec3 texelOf(LatticeParams lattice, uint number) {
    const uint row = uint(lattice.size.x), plane = row * uint(lattice.size.y), rest = number % plane;
    return ivec3(rest % row, rest / row, number / plane);
}
// Grid coordinates.
vec3 texelPosition(LatticeParams lattice, ivec3 texel) {
    return min(vec3(texel) * lattice.voxels_per_texel, vec3(lattice.volume.size - 1));
}

uint orderOf(LatticeParams lattice, uint bounce) { return (lattice.orders >> (4u * bounce)) & 15u; }

// Irradiance from a payload: sum over bounces of albedo^k E_k. READ(i) is number i of the payload.
#define TEXEL_IRRADIANCE(name, READ)                                                                     \
    vec3 name##Irradiance(LatticeParams lattice, TexelWords payload) {                                   \
        vec3 sum = vec3(0.0), weight = vec3(1.0);                                                        \
        for (uint k = 0u; k <= lattice.bounces; ++k) {                                                   \
            sum += weight * vec3(READ(3u * k), READ(3u * k + 1u), READ(3u * k + 2u));                    \
            weight *= lattice.albedo;                                                                    \
        }                                                                                                \
        return sum;                                                                                      \
    }                                                                                                    \
    vec3 name##Transferred(LatticeParams lattice, TexelWords payload) {                                  \
        vec3 sum = vec3(0.0), weight = vec3(1.0);                                                        \
        LightHarmonics light = LightHarmonics(lattice.light.harmonics);                                  \
        uint first = 0u;                                                                                 \
        for (uint k = 0u; k <= lattice.bounces; ++k) {                                                   \
            const uint count = orderOf(lattice, k) * orderOf(lattice, k);                                \
            vec3 part = vec3(0.0);                                                                       \
            for (uint i = 0u; i < count; ++i) part += READ(first + i) * light.at[i];                     \
            sum += weight * part;                                                                        \
            weight *= lattice.albedo;                                                                    \
            first += count;                                                                              \
        }                                                                                                \
        return max(sum, vec3(0.0));                                                                      \
    }
#define READ_FLOAT(i) uintBitsToFloat(payload.at[i])
#define READ_HALF(i) unpackHalf2x16(payload.at[(i) >> 1u])[(i) & 1u]
TEXEL_IRRADIANCE(float, READ_FLOAT)
TEXEL_IRRADIANCE(half, READ_HALF)

// model::TexelStorage
#define TEXELS_FLOAT32 0u
#define TEXELS_FLOAT16 1u
#define TEXELS_RGB8 2u

uint texelWords(LatticeParams lattice, uint storage) {
    return storage == TEXELS_RGB8 ? 1u : storage == TEXELS_FLOAT16 ? (lattice.stride + 1u) / 2u : lattice.stride;
}

// Roots keep dark texels apart.
uint packRgb8(LatticeParams lattice, vec3 irradiance) {
    return packUnorm4x8(vec4(sqrt(clamp(irradiance * (0.318309886 / lattice.rgb8_scale), 0.0, 1.0)), 1.0));
}
vec3 rgb8Irradiance(LatticeParams lattice, TexelWords payload) {
    const vec3 root = unpackUnorm4x8(payload.at[0]).rgb;
    return root * root * (3.14159265 * lattice.rgb8_scale);
}

vec3 payloadIrradiance(LatticeParams lattice, TexelWords payload, bool transfer, uint storage) {
    if (storage == TEXELS_RGB8) return rgb8Irradiance(lattice, payload);
    if (transfer) return storage == TEXELS_FLOAT16 ? halfTransferred(lattice, payload) : floatTransferred(lattice, payload);
    return storage == TEXELS_FLOAT16 ? halfIrradiance(lattice, payload) : floatIrradiance(lattice, payload);
}

// Whether a texel of this state needs no more paths.
bool texelDone(LatticeParams lattice, uint state) {
    const uint samples = 1u << (((state >> TEXEL_STAGE_SHIFT) & TEXEL_STAGE_MASK) - 1u);
    return samples >= lattice.samples_max || (samples >= lattice.samples_least && unpackHalf2x16(state).x <= lattice.relative_error);
}

uvec2 packShown(vec3 radiance, vec3 normal, bool done) {
    const vec3 clamped = clamp(radiance, 0.0, 65000.0);
    const uint octahedral = packSnorm4x8(vec4(octahedralOf(normal), 0.0, 0.0)) & 0xffffu;
    return uvec2((packHalf2x16(clamped.xy) & 0x7fff7fffu) | (done ? TEXEL_SHOWN_DONE : 0u),
                 (packHalf2x16(vec2(clamped.z, 0.0)) & 0x7fffu) | TEXEL_SHOWN_LIT | (octahedral << 16u));
}
vec3 shownRadiance(uvec2 shown) { return vec3(unpackHalf2x16(shown.x & 0x7fff7fffu), unpackHalf2x16(shown.y & 0x7fffu).x); }
vec3 shownNormal(uvec2 shown) { return vectorOfOctahedral(unpackSnorm4x8(shown.y >> 16u).xy); }

float luminance(vec3 colour) { return dot(colour, vec3(0.2126, 0.7152, 0.0722)); }

#endif
