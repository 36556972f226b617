// A fiblet decoded by a tessellation control shader: each invocation walks up to the last of the points that it keeps; none may write
// another's. Level 0 discards a patch. Source: Schertzer et al. 2022, Sec. 4.5.2.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/fiblet/layer_buffers.glsl"
#include "shaders/fiblet/walk.glsl"
#include "shaders/fiblet/line_end.glsl"
#include "shaders/fiblet/line_walk.glsl"
#include "shaders/fiblet/patch.glsl"

layout(vertices = 4) out;

layout(constant_id = 3) const bool kSelection = false;  // fibres have states
layout(constant_id = 4) const bool kTubes = false;      // of selected fibres, which are left out

layout(push_constant, scalar) uniform Push { LayerBuffer layer; } push;

layout(location = 0) in uint fiblet[];
layout(location = 0) out vec4 points[][kPartPoints];  // and the segment that begins there
layout(location = 16) patch out uvec2 fiblet_and_lines;

uint lines = 0u;
vec4 end;  // of the lines so far

void keep(uint point, vec4 place) {
    const uint first = uint(gl_InvocationID) * kPartPoints;
    if (point >= first && point < first + kPartPoints) points[gl_InvocationID][point - first] = place;
}

bool takeLine(FibletView view, uint fiblet, FibletLine line) {
    keep(lines++, vec4(line.a, float(line.first)));
    end = vec4(line.b, float(line.first + line.count));
    // The first counts them, where they are not as many as the segments.
    return lines < (uint(gl_InvocationID) + 1u) * kPartPoints || (kFewerLines && gl_InvocationID == 0);
}

void main() {
    const FibletLayerParams layer = push.layer.layer;
    const FibletWalk walk = beginWalk(layer, fiblet[0]);
    bool drawn = walk.segments > 0u;
    if (kSelection) {
        const uint state = fibreState(layer, walk.fibre);
        drawn = drawn && state != FIBRE_HIDDEN && !(kTubes && state == FIBRE_SELECTED);
    }
    if (drawn) {
        takeLines(layer, walk, fiblet[0]);
        keep(lines, end);
    }
    if (gl_InvocationID == 0) {
        if (!kFewerLines && drawn) lines = walk.segments;
        fiblet_and_lines = uvec2(fiblet[0], lines);
        gl_TessLevelOuter[0] = drawn ? 1.0 : 0.0;
        gl_TessLevelOuter[1] = float(lines);
    }
}
