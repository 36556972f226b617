// First hits of an isosurface layer: one invocation per pixel. Reads and writes the surface buffer, so nearer layers stop it early.
// Who is hit, in the surface buffer, is the cell: i + size.x (j + size.y k).
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_ballot : require
#include "shaders/isosurface/layer.glsl"

layout(constant_id = 5) const bool kFirstLayer = true;  // nothing is in the surface buffer yet

layout(buffer_reference, scalar) buffer CounterBuffer { uint hit_pixels; uint capped_rays; };

layout(push_constant, scalar) uniform Push {
    FrameBuffer frame;
    SurfaceLayerBuffer layer;
    SurfaceBuffer surface;
    CounterBuffer counters;
    uint first_block_row;  // of this dispatch, in blocks of 8x8 pixels
} push;

void main() {
    const FrameParams frame = push.frame.frame;
    const uvec2 pixel = pixelOfInvocation(push.first_block_row);
    const bool inside = pixel.x < frame.width && pixel.y < frame.height;
    const uint at = pixel.y * frame.width + pixel.x;
    const PixelRay ray = pixelRay(frame.rays, vec2(frame.width, frame.height), vec2(pixel) + 0.5 + frame.jitter);
    float nearest = ray.far;
    uint earlier_steps = 0u;
    bool empty_before = true;
    if (inside && !kFirstLayer) {
        nearest = min(nearest, push.surface.at[at].depth);
        earlier_steps = push.surface.at[at].layer_and_steps & 0xffffffu;
        empty_before = push.surface.at[at].who == 0xffffffffu;
    }
    bool hit_here = false;
    if (inside) {
        const IsosurfaceParams layer = push.layer.at[0];
        const VolumeHit hit = hitSurface(layer, gridRay(layer, ray.origin, ray.direction), ray.near, nearest);
        const uint steps = min(earlier_steps + hit.steps, 0xffffffu);
        hit_here = hit.t < nearest;
        if (hit_here) {
            const uint cell = uint(hit.cell.x) + uint(layer.volume.size.x) * (uint(hit.cell.y) + uint(layer.volume.size.y) * uint(hit.cell.z));
            push.surface.at[at] =
                Surface(hit.t, cell, surfaceNormal(layer.volume, hit, ray.direction), layer.layer << 24u | steps);
        } else if (kFirstLayer) {
            push.surface.at[at].depth = uintBitsToFloat(0x7f800000u);
            push.surface.at[at].who = 0xffffffffu;
            push.surface.at[at].layer_and_steps = steps;
        } else {
            push.surface.at[at].layer_and_steps = (push.surface.at[at].layer_and_steps & 0xff000000u) | steps;
        }
    }
    const uint hits = subgroupBallotBitCount(subgroupBallot(hit_here && empty_before));
    if (subgroupElect() && hits > 0u) atomicAdd(push.counters.hit_pixels, hits);
}
