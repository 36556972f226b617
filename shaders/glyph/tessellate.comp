// Deforms the mesh of a sphere into glyphs: one invocation per vertex, one row of workgroups per listed glyph, as dmri-explorer
// and MRtrix do it. Normals are those of the glyph itself (Peters et al. 2023, Eq. 11) in the mesh's directions.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/common/invocation.glsl"
#include "shaders/glyph/layer.glsl"
#include "shaders/common/glyph_normal.glsl"
#include "shaders/shared/raster.glsl"

layout(buffer_reference, scalar) readonly buffer DirectionBuffer { vec3 at[]; };
layout(buffer_reference, scalar) writeonly buffer VertexBuffer { MeshVertex at[]; };

layout(push_constant, scalar) uniform Push {
    LayerBuffer layer;
    UintBuffer list;            // glyphs to draw
    DirectionBuffer directions;
    VertexBuffer vertices;      // those of one glyph after the other
    uint first;                 // of the list's glyphs that are deformed by this dispatch
    uint vertex_count;          // per glyph
} push;

void main() {
    const uint vertex = globalInvocation();
    if (vertex >= push.vertex_count) return;
    const GlyphLayerParams layer = push.layer.layer;
    const GlyphInstance instance = InstanceBuffer(layer.instances).at[push.list.at[push.first + gl_WorkGroupID.y]];
    loadCoefficients(layer.coefficients, layer.stride, instance.slot);
    const vec3 p = push.directions.at[vertex];
    vec4 slope = shEvaluateGradient(glyph_coefficients, p);
    // Hidden lobes shrink to the centre; the normal there is that of the rim which they hang on.
    if (!kBothLobes) slope.w = max(slope.w, 0.0);
    push.vertices.at[gl_WorkGroupID.y * push.vertex_count + vertex] =
        MeshVertex(instance.scale * abs(slope.w) * p, glyphNormal(slope, p));
}
