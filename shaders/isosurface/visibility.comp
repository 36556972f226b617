// Which of a pixel's secondary rays meet an isosurface: one invocation per pixel, one bit per ray. Several layers add their bits.
// A ray from a point of this very surface begins half a voxel off it along its normal, on the side that the light falls on, so that
// the facets of trilinear cells do not shade themselves. Source of the offset: Wyman et al. 2006, Sec. 4.1.1.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/isosurface/layer.glsl"

const uint kHardRays = 0u, kSoftRays = 1u, kAmbientRays = 2u;
layout(constant_id = 20) const uint kRays = 0u;
layout(constant_id = 22) const bool kFirstCaster = true;  // no layer has written bits yet
layout(constant_id = 23) const uint kRayCount = 1u;       // 1 to 32
#include "shaders/common/secondary_rays.glsl"

layout(buffer_reference, scalar) buffer BitBuffer { uint at[]; };

layout(push_constant, scalar) uniform Push {
    FrameBuffer frame;
    SurfaceLayerBuffer layer;
    SurfaceBuffer surface;
    BitBuffer blocked;
    uint first_block_row;  // of this dispatch, in blocks of 8x8 pixels
} push;

// Value less the isovalue, of a point relative to the frame's reference point; where there is none, none.
float valueAt(IsosurfaceParams layer, vec3 point) {
    ivec3 cell;
    vec3 at;
    return marchValue(layer.volume, gridRay(layer, point, vec3(0.0)), layer.isovalue, 0.0, cell, at);
}

// Where rays from a point of this surface begin: off it, on the side of its normal, by half a voxel or by up to two if the surface is
// rough there.
vec3 startOff(IsosurfaceParams layer, vec3 point, vec3 normal) {
    const vec3 step = 0.5 * layer.volume.voxel_mm * normal;
    const bool rises = valueAt(layer, point + step) > valueAt(layer, point - step);
    for (float length = 1.0; length < 4.0; length *= 2.0) {
        if ((valueAt(layer, point + length * step) >= 0.0) == rises) return point + length * step;
    }
    return point + 4.0 * step;
}

void main() {
    const FrameParams frame = push.frame.frame;
    const uvec2 pixel = pixelOfInvocation(push.first_block_row);
    if (pixel.x >= frame.width || pixel.y >= frame.height) return;
    const uint at = pixel.y * frame.width + pixel.x;
    const Surface surface = push.surface.at[at];
    if (surface.who == 0xffffffffu) return;
    const IsosurfaceParams layer = push.layer.at[0];
    uint rays = makeRays(frame, surface.normal, at);
    uint blocked = kFirstCaster ? 0u : push.blocked.at[at];
    rays &= ~blocked;
    const PixelRay ray = pixelRay(frame.rays, vec2(frame.width, frame.height), vec2(pixel) + 0.5 + frame.jitter);
    vec3 point = ray.origin + surface.depth * ray.direction;
    if (surface.layer_and_steps >> 24u == layer.layer && rays != 0u) point = startOff(layer, point, surface.normal);
    const float t_max = kRays == kAmbientRays ? frame.occlusion_radius : 1e30;
    while (rays != 0u) {
        const int i = findLSB(rays);
        rays &= rays - 1u;
        if (hitSurface(layer, gridRay(layer, point, directions[i]), 0.0, t_max).t < VOLUME_MISS) blocked |= 1u << i;
    }
    push.blocked.at[at] = blocked;
}
