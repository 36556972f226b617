// A fiblet decoded by a tessellation control shader: each invocation walks up to the last of the points that it keeps; none may write
// another's. Level 0 discards a patch. Source: Schertzer et al. 2022, Sec. 4.5.2.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/fiblet/layer_buffers.glsl"
#include "shaders/fiblet/walk.glsl"
#include "shaders/fiblet/patch.glsl"

layout(vertices = 4) out;

layout(constant_id = 3) const bool kSelection = false;  // fibres have states
layout(constant_id = 4) const bool kTubes = false;      // of selected fibres, which are left out

layout(push_constant, scalar) uniform Push { LayerBuffer layer; } push;

layout(location = 0) in uint fiblet[];
layout(location = 0) out vec3 points[][kPartPoints];
layout(location = 16) patch out uvec2 fiblet_and_segments;

void main() {
    const FibletLayerParams layer = push.layer.layer;
    FibletWalk walk = beginWalk(layer, fiblet[0]);
    bool drawn = walk.segments > 0u;
    if (kSelection) {
        const uint state = fibreState(layer, walk.fibre);
        drawn = drawn && state != FIBRE_HIDDEN && !(kTubes && state == FIBRE_SELECTED);
    }
    if (gl_InvocationID == 0) {
        fiblet_and_segments = uvec2(fiblet[0], walk.segments);
        gl_TessLevelOuter[0] = drawn ? 1.0 : 0.0;
        gl_TessLevelOuter[1] = drawn ? float(walk.segments) : 0.0;
    }
    if (!drawn) return;
    const uint first = uint(gl_InvocationID) * kPartPoints;
    for (uint point = 0u; point <= walk.segments && point < first + kPartPoints; ++point) {
        if (point > 0u) stepWalk(layer, walk, point - 1u);
        if (point >= first) points[gl_InvocationID][point - first] = walk.pen.point;
    }
}
