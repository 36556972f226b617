// Samples of glyph functions for their bounds: one workgroup for four glyphs, one invocation for every 64th direction, so that
// each value of the basis that is read serves four glyphs and each coefficient is read from shared memory by all at once.
// Source: Peters et al. 2023, Sec. 4.2 (extensive search); the directions have a proven covering radius, see server/build/bounds.h.
// Twin: BoundsEvaluator (server/build/bounds.cpp), which samples in the same directions on the CPU.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#include "shaders/common/invocation.glsl"
#include "shaders/shared/glyph_bounds.glsl"

layout(constant_id = 1) const uint kCount = 1u;  // coefficients of the layout

const uint kGlyphs = 4u;          // per workgroup
const uint kCountMost = 289u;     // band 16, all bands
const uint kValues = 14u;         // of GlyphExtremes
const uint kSubgroupsMost = 64u;  // invocations of a workgroup
const float kLeast = -3.0e38;

layout(buffer_reference, scalar) readonly buffer FloatBuffer { float at[]; };
layout(buffer_reference, scalar) readonly buffer UintBuffer { uint at[]; };
layout(buffer_reference, scalar) writeonly buffer ExtremesBuffer { float at[]; };

layout(push_constant, scalar) uniform Push {
    FloatBuffer coefficients;  // [slot][stride]
    UintBuffer slots;          // [glyphs]
    FloatBuffer unit;          // [glyphs]: what to multiply coefficients by, so that the largest is about 1
    FloatBuffer table;         // [x, y, z, basis functions][directions]
    ExtremesBuffer extremes;   // [glyphs]
    uint glyphs;
    uint stride;
    uint directions;
    uint first;  // glyph of this dispatch
} push;

shared float coefficients[kCountMost * kGlyphs];
shared float partial[kValues * kSubgroupsMost];

GlyphExtremes nothing() { return GlyphExtremes(kLeast, 0.0, vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0)); }

void add(inout GlyphExtremes e, float f, vec3 direction) {
    const vec3 positive = direction * max(f, 0.0), negative = direction * max(-f, 0.0);
    e.f_max = max(e.f_max, f);
    e.f_low = max(e.f_low, -f);
    e.positive_up = max(e.positive_up, positive);
    e.positive_down = max(e.positive_down, -positive);
    e.negative_up = max(e.negative_up, negative);
    e.negative_down = max(e.negative_down, -negative);
}

void keep(uint value, float of_invocation) {
    const float largest = subgroupMax(of_invocation);
    if (subgroupElect()) partial[value * kSubgroupsMost + gl_SubgroupID] = largest;
}

void keep(uint first, vec3 of_invocation) {
    keep(first, of_invocation.x);
    keep(first + 1u, of_invocation.y);
    keep(first + 2u, of_invocation.z);
}

// The largest over the workgroup, written in the order of GlyphExtremes.
void write(uint glyph, GlyphExtremes e) {
    keep(0u, e.f_max);
    keep(1u, e.f_low);
    keep(2u, e.positive_up);
    keep(5u, e.positive_down);
    keep(8u, e.negative_up);
    keep(11u, e.negative_down);
    barrier();
    if (localInvocation() < kValues && glyph < push.glyphs) {
        float largest = partial[localInvocation() * kSubgroupsMost];
        for (uint i = 1u; i < gl_NumSubgroups; ++i) largest = max(largest, partial[localInvocation() * kSubgroupsMost + i]);
        push.extremes.at[glyph * kValues + localInvocation()] = largest;
    }
    barrier();
}

void main() {
    const uint first = push.first + gl_WorkGroupID.x * kGlyphs;
    for (uint i = localInvocation(); i < kCount * kGlyphs; i += gl_WorkGroupSize.x) {
        const uint glyph = min(first + i % kGlyphs, push.glyphs - 1u), j = i / kGlyphs;
        coefficients[i] = push.coefficients.at[push.slots.at[glyph] * push.stride + j] * push.unit.at[glyph];
    }
    barrier();
    GlyphExtremes extremes[kGlyphs] = GlyphExtremes[](nothing(), nothing(), nothing(), nothing());
    for (uint d = localInvocation(); d < push.directions; d += gl_WorkGroupSize.x) {
        vec4 f = vec4(0.0);
        for (uint j = 0u; j < kCount; ++j) {
            const uint at = j * kGlyphs;
            f += push.table.at[(j + 3u) * push.directions + d] *
                 vec4(coefficients[at], coefficients[at + 1u], coefficients[at + 2u], coefficients[at + 3u]);
        }
        const vec3 direction =
            vec3(push.table.at[d], push.table.at[push.directions + d], push.table.at[2u * push.directions + d]);
        for (uint g = 0u; g < kGlyphs; ++g) add(extremes[g], f[g], direction);
    }
    for (uint g = 0u; g < kGlyphs; ++g) write(first + g, extremes[g]);
}
