// A fiblet decoded by a geometry shader, which emits its points as it walks along. Source: Schertzer et al. 2022, Sec. 4.5.1.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/fiblet/layer_buffers.glsl"
#include "shaders/fiblet/walk.glsl"
#include "shaders/fiblet/line_end.glsl"

layout(points) in;
layout(line_strip, max_vertices = 64) out;

layout(constant_id = 3) const bool kSelection = false;  // fibres have states
layout(constant_id = 4) const bool kTubes = false;      // of selected fibres, which are left out

layout(push_constant, scalar) uniform Push { LayerBuffer layer; } push;

layout(location = 0) in uint fiblet[];
layout(location = 0) flat out vec4 from;  // of the segment that begins here
layout(location = 1) flat out vec4 to;
layout(location = 2) flat out uint who;

void main() {
    const FibletLayerParams layer = push.layer.layer;
    FibletWalk walk = beginWalk(layer, fiblet[0]);
    if (kSelection) {
        const uint state = fibreState(layer, walk.fibre);
        if (state == FIBRE_HIDDEN || (kTubes && state == FIBRE_SELECTED)) return;
    }
    vec4 here = fibletEyePoint(layer.view, walk.pen.point);
    for (uint segment = 0u; segment <= walk.segments; ++segment) {
        vec4 next = here;
        if (segment < walk.segments) {
            stepWalk(layer, walk, segment);
            next = fibletEyePoint(layer.view, walk.pen.point);
        }
        from = here;
        to = next;
        who = fiblet[0] << FIBLET_SEGMENT_BITS | segment;
        gl_Position = fibletClip(layer.view, here);
        EmitVertex();
        here = next;
    }
    EndPrimitive();
}
