// Decoded fiblets for pull.vert, and the draw of them: one invocation per fiblet, unless its fibre is hidden. All of its points go to a
// slot; where lines may stand for many segments, its lines to a list.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/common/invocation.glsl"
#include "shaders/fiblet/layer.glsl"
#include "shaders/fiblet/walk.glsl"
#include "shaders/fiblet/line_end.glsl"
#include "shaders/fiblet/line_walk.glsl"

layout(constant_id = 1) const bool kListed = false;     // fiblets of the list; else all in their order
layout(constant_id = 3) const bool kSelection = false;  // fibres have states
layout(constant_id = 4) const bool kTubes = false;      // of selected fibres, which are left out

layout(buffer_reference, scalar) buffer SlotBuffer { FibletSlot at[]; };
layout(buffer_reference, scalar) buffer LineBuffer { FibletListedLine at[]; };
layout(buffer_reference, scalar) buffer DrawBuffer { uint vertices; uint instances; uint first_vertex; uint first_instance; };
layout(push_constant, scalar) uniform Push {
    LayerBuffer layer;
    SlotBuffer slots;
    DrawBuffer command;
    uint first;  // of the list, or of all fiblets
    uint count;
} push;

uint slot;

bool takeLine(FibletView view, uint fiblet, FibletLine line) {
    if (kFewerLines) {
        const uint at = atomicAdd(push.command.vertices, 2u) >> 1u;
        LineBuffer(push.slots).at[at] = FibletListedLine(line.eye_a, line.eye_b, fiblet << FIBLET_SEGMENT_BITS | line.first, line.count);
    } else {
        SlotBuffer slots = push.slots;
        slots.at[slot].eye[line.first + 1u] = line.eye_b;
    }
    return true;
}

void main() {
    if (globalInvocation() >= push.count) return;
    const FibletLayerParams layer = push.layer.layer;
    const uint at = push.first + globalInvocation();
    const uint fiblet = kListed ? UintBuffer(layer.list).at[at] : at;
    FibletWalk walk = beginWalk(layer, fiblet);
    if (kSelection) {
        const uint state = fibreState(layer, walk.fibre);
        if (state == FIBRE_HIDDEN || (kTubes && state == FIBRE_SELECTED)) return;
    }
    if (!kFewerLines) {
        SlotBuffer slots = push.slots;
        slot = atomicAdd(push.command.instances, 1u);
        slots.at[slot].fiblet = fiblet;
        slots.at[slot].segments = walk.segments;
        slots.at[slot].eye[0] = fibletEyePoint(layer.view, walk.pen.point);
    }
    takeLines(layer, walk, fiblet);
}
