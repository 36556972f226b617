// The nearest crossing of each pixel's ray with transparent isosurfaces that is not composed yet, where it lies before what other
// layers have found. One invocation per pixel.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/isosurface/layer.glsl"
#include "shaders/shared/layer_look.glsl"
#include "shaders/shared/peel.glsl"

layout(constant_id = 5) const uint kCrossings = 16u;    // that are counted, at most, of one ray and layer
layout(constant_id = 6) const bool kCounting = false;   // the first round of a moving picture

layout(buffer_reference, scalar) readonly buffer LookBuffer { LayerLook at[]; };
layout(buffer_reference, scalar) buffer PeelBuffer { PeelParams peel; };
layout(buffer_reference, scalar) buffer FloatBuffer { float at[]; };

layout(push_constant, scalar) uniform Push {
    FrameBuffer frame;
    SurfaceLayerBuffer layers;
    SurfaceBuffer opaque, found;
    LookBuffer looks;
    PeelBuffer peel;
    uint transparent;      // bit i: layer i is a transparent isosurface
    uint first_block_row;  // of this dispatch, in blocks of 8x8 pixels
} push;

// A little behind a crossing, on the surface's other side.
float behind(IsosurfaceParams layer, float t) { return t + 1e-3 * layer.volume.voxel_mm; }

void main() {
    const FrameParams frame = push.frame.frame;
    const uvec2 pixel = pixelOfInvocation(push.first_block_row);
    if (pixel.x >= frame.width || pixel.y >= frame.height) return;
    const uint at = pixel.y * frame.width + pixel.x;
    const PixelRay ray = pixelRay(frame.rays, vec2(frame.width, frame.height), vec2(pixel) + 0.5 + frame.jitter);
    const float far = min(ray.far, push.opaque.at[at].depth);
    float nearest = min(far, push.found.at[at].depth);
    float through = 1.0;
    for (uint i = 0u; i < 8u; ++i) {
        if ((push.transparent >> i & 1u) == 0u) continue;
        const IsosurfaceParams layer = push.layers.at[i];
        const GridRay own = gridRay(layer, ray.origin, ray.direction);
        const float begin = max(ray.near, behind(layer, FloatBuffer(push.peel.peel.crossings[i]).at[at]));
        const VolumeHit hit = hitSurface(layer, own, begin, kCounting ? far : nearest);
        if (hit.t < nearest) {
            nearest = hit.t;
            push.found.at[at] = Surface(hit.t, 0u, surfaceNormal(layer.volume, hit, ray.direction), i << 24u);
        }
        if (!kCounting) continue;
        float t = hit.t;
        for (uint crossing = 0u; crossing < kCrossings && t < far; ++crossing) {
            through *= 1.0 - push.looks.at[i].opacity;
            t = hitSurface(layer, own, behind(layer, t), far).t;
        }
    }
    if (kCounting) FloatBuffer(push.peel.peel.rest).at[at] *= through;
}
