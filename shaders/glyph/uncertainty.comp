// How much of a layer's second glyphs lies before each pixel's surface: one invocation per pixel, after all layers are traced.
// Their boxes are visited in any order up to the surface's depth; lengths add up, also where glyphs overlap.
// Source: Peters et al. 2023, Sec. 4.3; lengths by common/circle_inside.glsl.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#include "shaders/common/invocation.glsl"
#include "shaders/glyph/layer.glsl"
#include "shaders/glyph/intersect.glsl"
#include "shaders/common/circle_inside.glsl"
#include "shaders/shared/bvh.glsl"
#include "shaders/shared/uncertainty.glsl"

layout(buffer_reference, scalar) readonly buffer NodeBuffer { BvhNode at[]; };
layout(buffer_reference, scalar) readonly buffer UncertaintyBuffer { UncertaintyParams params; };
layout(buffer_reference, scalar) buffer MediumBuffer { Medium at[]; };

layout(push_constant, scalar) uniform Push {
    FrameBuffer frame;
    UncertaintyBuffer uncertainty;
    SurfaceBuffer surface;
    MediumBuffer media;
    CounterBuffer counters;
    uint first_block_row;  // of this dispatch, in blocks of 8x8 pixels
} push;

const uint kNone = 0xffffffffu;
float travelled = 0.0;  // mm

// The candidate that visitInstance() has found; best_t is the surface's depth and stays.
void travel(FrameParams frame, GlyphLayerParams layer, uint index) {
    const GlyphInstance instance = candidate;
    const float unit = 1.0 / instance.scale;
    const RayPlane plane = rayPlane((ray.origin - candidate_centre) * unit, ray.direction);
    const float radius = instance.radius * unit;
    if (plane.h >= radius) return;
    vec2 F[CIRCLE_HARMONICS + 1];
    instanceCircle(frame, layer, index, instance, candidate_centre, plane, F);
    const CircleInside inside =
        circleInside(F, plane.h, plane.closest, radius, ray.near * unit, best_t * unit, kBothLobes);
    travelled += inside.travelled * instance.scale;
    capped_rays += inside.capped ? 1u : 0u;
}

void traverseTiles(FrameParams frame, GlyphLayerParams layer, uvec2 pixel) {
    const uint tile = (pixel.y >> kTileShiftY) * frame.tiles_x + (pixel.x >> kTileShiftX);
    const uvec2 range = RangeBuffer(layer.tile_ranges).at[tile];
    UintBuffer entries = UintBuffer(layer.tile_lists);
    uint next = range.x;
    const uint end = range.x + range.y;
    while (next < end) {
        uint found = kNone;
        while (next < end && found == kNone) {
            const uint index = entries.at[next++];
            if (visitInstance(frame, layer, index)) found = index;
        }
        if (found != kNone) travel(frame, layer, found);
    }
}

void traverseHierarchy(FrameParams frame, GlyphLayerParams layer) {
    const vec3 origin = ray.origin + frame.rays.scene_from_reference;
    NodeBuffer nodes = NodeBuffer(layer.bvh_nodes);
    UintBuffer order = UintBuffer(layer.bvh_order);
    uvec2 stack[BVH_DEPTH_MAX];
    int top = 0;
    uvec2 current = uvec2(0u, BVH_INNER);  // index, count as in BvhNode
    bool more = true;
    while (more) {
        uint found = kNone;
        while (more && found == kNone) {
            bool done = true;  // with what `current` was
            if (current.y == BVH_INNER) {
                const BvhNode node = nodes.at[current.x];
                const vec2 span0 = boxSpan(origin, ray_inverse, node.min0, node.max0);
                const vec2 span1 = boxSpan(origin, ray_inverse, node.min1, node.max1);
                const bool in0 = span0.x <= span0.y && span0.x < best_t && span0.y >= ray.near && node.count0 != 0u;
                const bool in1 = span1.x <= span1.y && span1.x < best_t && span1.y >= ray.near && node.count1 != 0u;
                const uvec2 child0 = uvec2(node.index0, node.count0), child1 = uvec2(node.index1, node.count1);
                if (in0 && in1) stack[top++] = child1;
                current = in0 ? child0 : child1;
                done = !in0 && !in1;
            } else {
                const uint index = order.at[current.x];
                if (visitInstance(frame, layer, index)) found = index;
                current = uvec2(current.x + 1u, current.y - 1u);
                done = current.y == 0u;
            }
            if (done) {
                more = top > 0;
                if (more) current = stack[--top];
            }
        }
        if (found != kNone) travel(frame, layer, found);
    }
}

void main() {
    const FrameParams frame = push.frame.frame;
    const UncertaintyParams params = push.uncertainty.params;
    const uvec2 pixel = pixelOfInvocation(push.first_block_row);
    if (pixel.x < frame.width && pixel.y < frame.height) {
        const uint at = pixel.y * frame.width + pixel.x;
        ray = pixelRay(frame.rays, vec2(frame.width, frame.height), vec2(pixel) + 0.5 + frame.jitter);
        ray_inverse = inverseDirection(ray.direction);
        best_t = min(ray.far, push.surface.at[at].depth);
        if (kTraversal == 1u) traverseTiles(frame, params.glyphs, pixel);
        else traverseHierarchy(frame, params.glyphs);
        const float optical_depth = params.extinction * travelled;
        Medium medium = Medium(optical_depth * params.emission, optical_depth);
        if (!kFirstLayer) {
            const Medium before = push.media.at[at];
            medium.weighted_emission += before.weighted_emission;
            medium.optical_depth += before.optical_depth;
        }
        push.media.at[at] = medium;
    }
    const uint capped = subgroupAdd(capped_rays);
    if (subgroupElect() && capped > 0u) atomicAdd(push.counters.capped_rays, capped);
}
