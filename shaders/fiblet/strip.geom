// A fiblet decoded by a geometry shader, which emits its points as it walks along. Source: Schertzer et al. 2022, Sec. 4.5.1.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/fiblet/layer_buffers.glsl"
#include "shaders/fiblet/walk.glsl"
#include "shaders/fiblet/line_end.glsl"
#include "shaders/fiblet/line_walk.glsl"

layout(points) in;
layout(line_strip, max_vertices = 64) out;

layout(constant_id = 3) const bool kSelection = false;  // fibres have states
layout(constant_id = 4) const bool kTubes = false;      // of selected fibres, which are left out

layout(push_constant, scalar) uniform Push { LayerBuffer layer; } push;

layout(location = 0) in uint fiblet[];
layout(location = 0) flat out vec4 from;  // of the segment that begins here
layout(location = 1) flat out vec4 to;
layout(location = 2) flat out uvec2 who;  // and number of segments

vec4 end = vec4(0.0);  // of the strip so far

bool takeLine(FibletView view, uint fiblet, FibletLine line) {
    from = line.eye_a;
    to = end = line.eye_b;
    who = uvec2(fiblet << FIBLET_SEGMENT_BITS | line.first, line.count);
    gl_Position = fibletClip(view, line.eye_a);
    EmitVertex();
    return true;
}

void main() {
    const FibletLayerParams layer = push.layer.layer;
    const FibletWalk walk = beginWalk(layer, fiblet[0]);
    if (walk.segments == 0u) return;
    if (kSelection) {
        const uint state = fibreState(layer, walk.fibre);
        if (state == FIBRE_HIDDEN || (kTubes && state == FIBRE_SELECTED)) return;
    }
    takeLines(layer, walk, fiblet[0]);
    from = to = end;
    who = uvec2(FIBLET_NOBODY, 1u);
    gl_Position = fibletClip(layer.view, end);
    EmitVertex();
    EndPrimitive();
}
