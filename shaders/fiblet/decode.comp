// Points of fiblets for pull.vert, and the draw of them: one invocation per fiblet, which takes a slot unless its fibre is hidden.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/common/invocation.glsl"
#include "shaders/fiblet/layer.glsl"
#include "shaders/fiblet/walk.glsl"

layout(constant_id = 1) const bool kListed = false;     // fiblets of the list; else all in their order
layout(constant_id = 3) const bool kSelection = false;  // fibres have states
layout(constant_id = 4) const bool kTubes = false;      // of selected fibres, which are left out

layout(buffer_reference, scalar) buffer SlotBuffer { FibletSlot at[]; };
layout(buffer_reference, scalar) buffer DrawBuffer { uint vertices; uint instances; uint first_vertex; uint first_instance; };
layout(push_constant, scalar) uniform Push {
    LayerBuffer layer;
    SlotBuffer slots;
    DrawBuffer command;
    uint first;  // of the list, or of all fiblets
    uint count;
} push;

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
    SlotBuffer slots = push.slots;
    const uint slot = atomicAdd(push.command.instances, 1u);
    slots.at[slot].fiblet = fiblet;
    slots.at[slot].segments = walk.segments;
    slots.at[slot].eye[0] = fibletEyePoint(layer.view, walk.pen.point);
    for (uint segment = 0u; segment < walk.segments; ++segment) {
        stepWalk(layer, walk, segment);
        slots.at[slot].eye[segment + 1u] = fibletEyePoint(layer.view, walk.pen.point);
    }
}
