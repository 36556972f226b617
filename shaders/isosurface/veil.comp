// Transparent isosurfaces over what is opaque: one invocation per pixel follows its ray through all of them, nearest crossing first,
// and composites front to back. The light pass puts its picture behind.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/isosurface/layer.glsl"
#include "shaders/shared/layer_look.glsl"
#include "shaders/common/brdf.glsl"

layout(constant_id = 5) const uint kCrossings = 16u;  // at most, of one ray
layout(constant_id = 10) const uint kSurfaceLooks = 0u;  // what no layer has is not compiled
#include "shaders/common/surface_shading.glsl"

layout(buffer_reference, scalar) readonly buffer LookBuffer { LayerLook at[]; };
layout(buffer_reference, scalar) writeonly buffer VeilBuffer { vec4 at[]; };  // radiance, transmittance

layout(push_constant, scalar) uniform Push {
    FrameBuffer frame;
    SurfaceLayerBuffer layers;
    SurfaceBuffer surface;
    LookBuffer looks;
    VeilBuffer veil;
    SurfaceLookBuffer surface_looks;  // not read without kSurfaceLooks
    uint transparent;      // bit i: layer i is a transparent isosurface
    uint first_block_row;  // of this dispatch, in blocks of 8x8 pixels
} push;

// Radiance towards the viewer of a crossing at t of layer i.
vec3 veilRadiance(FrameParams frame, uint i, LayerLook look, PixelRay ray, float t, vec3 normal) {
    vec3 base = look.uniform_colour, lit;
    if (kSurfaceLooks == 0u) return shadeDielectric(base, 0.45, normal, -ray.direction, frame.light_direction, frame.irradiance, frame.ambient);
    const SurfaceLook own = push.surface_looks.at[i];
    base = surfaceColour(own, look, ray.origin + t * ray.direction);
    if (shadesItself(own)) lit = shadeItself(frame, own, base, normal, -ray.direction, 1.0, 1.0);
    else lit = shadeDielectric(base, 0.45, normal, -ray.direction, frame.light_direction, frame.irradiance, frame.ambient);
    return mix(lit, frame.background, surfaceFog(frame, own, ray, t));
}

void main() {
    const FrameParams frame = push.frame.frame;
    const uvec2 pixel = pixelOfInvocation(push.first_block_row);
    if (pixel.x >= frame.width || pixel.y >= frame.height) return;
    const uint at = pixel.y * frame.width + pixel.x;
    const PixelRay ray = pixelRay(frame.rays, vec2(frame.width, frame.height), vec2(pixel) + 0.5 + frame.jitter);
    const float behind = min(ray.far, push.surface.at[at].depth);
    // The next crossing of each layer; hits are found again when they are shaded, which is cheaper than keeping them all.
    float next[8];
    for (uint i = 0u; i < 8u; ++i) next[i] = (push.transparent >> i & 1u) != 0u ? ray.near : VOLUME_MISS;
    bool looked[8];
    for (uint i = 0u; i < 8u; ++i) looked[i] = false;
    VolumeHit hits[8];
    vec3 radiance = vec3(0.0);
    float through = 1.0;
    for (uint crossing = 0u; crossing < kCrossings && through > 1.0 / 512.0; ++crossing) {
        uint nearest = 8u;
        float t = behind;
        for (uint i = 0u; i < 8u; ++i) {
            if (!(next[i] < VOLUME_MISS)) continue;
            if (!looked[i]) {
                const IsosurfaceParams layer = push.layers.at[i];
                hits[i] = hitSurface(layer, gridRay(layer, ray.origin, ray.direction), next[i], behind);
                next[i] = hits[i].t;
                looked[i] = true;
            }
            if (next[i] < t) {
                t = next[i];
                nearest = i;
            }
        }
        if (nearest == 8u) break;
        const IsosurfaceParams layer = push.layers.at[nearest];
        const LayerLook look = push.looks.at[nearest];
        const vec3 normal = surfaceNormal(layer.volume, hits[nearest], ray.direction);
        const vec3 lit = veilRadiance(frame, nearest, look, ray, t, normal);
        radiance += through * look.opacity * min(lit, vec3(1.0));
        through *= 1.0 - look.opacity;
        // Go on a little behind, on the surface's other side.
        next[nearest] = t + 1e-3 * layer.volume.voxel_mm;
        looked[nearest] = false;
    }
    push.veil.at[at] = vec4(radiance, through);
}
