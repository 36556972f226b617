// What was drawn of one layer, into the surface buffer that all layers share: one invocation per pixel. Drawing writes images and
// not that buffer, as only for images does the device promise that the depth test, and of equal depths the order of drawing,
// decides what stays.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#include "shaders/common/invocation.glsl"
#include "shaders/shared/frame.glsl"
#include "shaders/common/depth_code.glsl"
#include "shaders/common/octahedral.glsl"

layout(constant_id = 1) const bool kFirstLayer = true;  // nothing is in the surface buffer yet
layout(constant_id = 2) const bool kBoxes = false;      // drawn by boxes.frag, else by mesh.frag

layout(buffer_reference, scalar) buffer SurfaceBuffer { Surface at[]; };
layout(buffer_reference, scalar) buffer CounterBuffer { uint hit_pixels; uint capped_rays; };
layout(buffer_reference, scalar) readonly buffer WordBuffer { uvec4 at[]; };
layout(buffer_reference, scalar) readonly buffer DepthBuffer { float at[]; };
layout(buffer_reference, scalar) readonly buffer StepBuffer { uint at[]; };

layout(push_constant, scalar) uniform Push {
    SurfaceBuffer surface;
    CounterBuffer counters;
    WordBuffer words;
    DepthBuffer depth;
    StepBuffer steps;  // boxes only
    uint pixels;
    uint layer;
} push;

const uint kNone = 0xffffffffu;

void main() {
    const uint at = globalInvocation();
    const bool inside = at < push.pixels;
    bool newly_hit = false;
    if (inside) {
        const float depth = push.depth.at[at];
        const uint earlier = kFirstLayer ? 0u : push.surface.at[at].layer_and_steps;
        const uint own_steps = kBoxes ? push.steps.at[at] : 0u;
        const uint steps = min(own_steps, 0xffffffu - (earlier & 0xffffffu)) + (earlier & 0xffffffu);
        if (depth > 0.0) {
            const uvec4 words = push.words.at[at];
            const float t = kBoxes ? parameterOfDepth(depth) : uintBitsToFloat(words.y);
            const vec3 normal = kBoxes ? uintBitsToFloat(words.yzw) : vectorOfOctahedral(uintBitsToFloat(words.zw));
            newly_hit = kFirstLayer || push.surface.at[at].who == kNone;
            push.surface.at[at] = Surface(t, words.x, normal, push.layer << 24u | steps);
        } else if (kFirstLayer) {
            push.surface.at[at].depth = uintBitsToFloat(0x7f800000u);
            push.surface.at[at].who = kNone;
            push.surface.at[at].layer_and_steps = steps;
        } else if (kBoxes) {
            push.surface.at[at].layer_and_steps = (earlier & 0xff000000u) | steps;
        }
    }
    const uint hits = subgroupAdd(newly_hit ? 1u : 0u);
    if (subgroupElect() && hits > 0u) atomicAdd(push.counters.hit_pixels, hits);
}
