// First hits of a glyph layer: one invocation per pixel. Reads and writes the surface buffer, so nearer layers stop it early.
// Sources: Peters et al. 2023, Sec. 4 (boxes, normals); hits by common/circle_march.glsl.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_ballot : require
#ifdef TRAVERSE_RAY_QUERY
#extension GL_EXT_ray_query : require
#endif
#define GLYPH_SHARED_READS
#include "shaders/common/invocation.glsl"
#include "shaders/glyph/layer.glsl"
#include "shaders/common/glyph_normal.glsl"
#include "shaders/glyph/intersect.glsl"
#include "shaders/shared/bvh.glsl"

layout(buffer_reference, scalar) readonly buffer NodeBuffer { BvhNode at[]; };

layout(push_constant, scalar) uniform Push {
    FrameBuffer frame;
    LayerBuffer layer;
    SurfaceBuffer surface;
    CounterBuffer counters;
    uint first_block_row;  // of this dispatch, in blocks of 8x8 pixels
} push;

const uint kNone = 0xffffffffu;

// The candidate that visitInstance() has found.
void process(FrameParams frame, GlyphLayerParams layer, uint index) {
    if (kBoxesOnly) {
        ++total_steps;
    } else {
        intersectInstance(frame, layer, index, candidate, candidate_centre);
    }
}

#ifdef TRAVERSE_RAY_QUERY
void traverse(FrameParams frame, GlyphLayerParams layer, uvec2 pixel) {
    // Scene coordinates, from the near plane on: ray queries know no negative parameters.
    const vec3 origin = ray.origin + frame.rays.scene_from_reference + ray.near * ray.direction;
    rayQueryEXT query;
    rayQueryInitializeEXT(query, accelerationStructureEXT(layer.acceleration), gl_RayFlagsNoneEXT, 0xff, origin, 0.0,
                          ray.direction, best_t - ray.near);
    while (rayQueryProceedEXT(query)) {
        const uint index = rayQueryGetIntersectionPrimitiveIndexEXT(query, false);
        if (visitInstance(frame, layer, index)) {
            const float before = best_t;
            process(frame, layer, index);
            if (best_t < before) rayQueryGenerateIntersectionEXT(query, max(best_t - ray.near, 0.0));
        }
    }
}
#else
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
        if (found != kNone) process(frame, layer, found);
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
            if (current.y == BVH_INNER) {
                const BvhNode node = nodes.at[current.x];
                const vec2 span0 = boxSpan(origin, ray_inverse, node.min0, node.max0);
                const vec2 span1 = boxSpan(origin, ray_inverse, node.min1, node.max1);
                const bool in0 = span0.x <= span0.y && span0.x < best_t && span0.y >= ray.near && node.count0 != 0u;
                const bool in1 = span1.x <= span1.y && span1.x < best_t && span1.y >= ray.near && node.count1 != 0u;
                const uvec2 child0 = uvec2(node.index0, node.count0), child1 = uvec2(node.index1, node.count1);
                const bool swap = in1 && (!in0 || span1.x < span0.x);
                current = swap ? child1 : child0;
                if (in0 && in1) stack[top++] = swap ? child0 : child1;
                if (!in0 && !in1) {
                    more = top > 0;
                    if (more) current = stack[--top];
                }
            } else {
                const uint index = order.at[current.x];
                if (visitInstance(frame, layer, index)) found = index;
                current = uvec2(current.x + 1u, current.y - 1u);
                if (current.y == 0u) {
                    more = top > 0;
                    if (more) current = stack[--top];
                }
            }
        }
        if (found != kNone) process(frame, layer, found);
    }
}

void traverse(FrameParams frame, GlyphLayerParams layer, uvec2 pixel) {
    if (kTraversal == 1u) traverseTiles(frame, layer, pixel);
    else traverseHierarchy(frame, layer);
}
#endif

// Turned towards the viewer.
vec3 hitNormal(GlyphLayerParams layer, uint index, vec3 p) {
#if defined METHOD_TENSOR || defined METHOD_ELLIPSOID
    const vec3 normal = methodNormal(layer, index, p);
#else
    loadCoefficients(layer.coefficients, layer.stride, InstanceBuffer(layer.instances).at[index].slot);
    const vec3 normal = glyphNormal(shEvaluateGradient(glyph_coefficients, p), p);
#endif
    return dot(normal, ray.direction) > 0.0 ? -normal : normal;
}

void main() {
    const FrameParams frame = push.frame.frame;
    const GlyphLayerParams layer = push.layer.layer;
    const uvec2 pixel = pixelOfInvocation(push.first_block_row);
    const bool inside = pixel.x < frame.width && pixel.y < frame.height;
    const uint at = pixel.y * frame.width + pixel.x;
    ray = pixelRay(frame.rays, vec2(frame.width, frame.height), vec2(pixel) + 0.5 + frame.jitter);
    ray_inverse = inverseDirection(ray.direction);
    uint earlier_steps = 0u;
    bool empty_before = true;
    best_t = ray.far;
    best_instance = kNone;
    if (inside && (!kFirstLayer || kBoxesOnly)) {
        best_t = min(best_t, push.surface.at[at].depth);
        earlier_steps = push.surface.at[at].layer_and_steps & 0xffffffu;
        empty_before = push.surface.at[at].who == kNone;
    }
    if (inside) traverse(frame, layer, pixel);
    const bool hit = inside && best_instance != kNone;
    if (kBoxesOnly) {
        // Something must be written, or the work is optimised away.
        if (inside && total_steps == 0xffffffu) push.surface.at[at].who = total_steps;
    } else if (hit) {
        push.surface.at[at] = Surface(best_t, best_instance, hitNormal(layer, best_instance, best_direction),
                                      layer.layer << 24u | min(earlier_steps + total_steps, 0xffffffu));
    } else if (inside && kFirstLayer) {
        // No normal: nobody reads it where nothing is, and stores are dear on CPU drivers.
        push.surface.at[at].depth = uintBitsToFloat(0x7f800000u);
        push.surface.at[at].who = kNone;
        push.surface.at[at].layer_and_steps = min(total_steps, 0xffffffu);
    } else if (inside) {
        push.surface.at[at].layer_and_steps += min(total_steps, 0xffffffu - earlier_steps);
    }
    if (!kBoxesOnly) {
        const uint hits = subgroupBallotBitCount(subgroupBallot(hit && empty_before));
        if (subgroupElect() && hits > 0u) atomicAdd(push.counters.hit_pixels, hits);
        if (capped_rays > 0u) atomicAdd(push.counters.capped_rays, capped_rays);
    }
}
