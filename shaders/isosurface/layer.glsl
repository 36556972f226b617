// One isosurface layer in a frame, and the hit of a pixel's ray with it. Included by the passes of shaders/isosurface.
#include "shaders/common/invocation.glsl"
#include "shaders/shared/frame.glsl"
#include "shaders/shared/isosurface.glsl"
#include "shaders/common/camera_rays.glsl"
#include "shaders/isosurface/trace_volume.glsl"
#include "shaders/isosurface/march_volume.glsl"

layout(constant_id = 1) const bool kBricks = true;
layout(constant_id = 2) const bool kMarch = false;          // march-bisect instead of the exact hit
layout(constant_id = 3) const bool kSplineNormals = true;   // else of the trilinear cell
layout(constant_id = 4) const uint kBisections = 10u;       // of march-bisect

layout(buffer_reference, scalar) readonly buffer FrameBuffer { FrameParams frame; };
layout(buffer_reference, scalar) readonly buffer SurfaceLayerBuffer { IsosurfaceParams at[]; };
layout(buffer_reference, scalar) buffer SurfaceBuffer { Surface at[]; };

// A ray of the world, mm, relative to the frame's reference point, in the layer's grid; t stays in mm.
GridRay gridRay(IsosurfaceParams layer, vec3 origin, vec3 direction) {
    return GridRay(layer.base, layer.fraction + gridVector(layer.volume, origin), gridVector(layer.volume, direction));
}

VolumeHit hitSurface(IsosurfaceParams layer, GridRay ray, float t_min, float t_max) {
    if (kMarch) return marchVolume(layer.volume, ray, layer.isovalue, t_min, t_max, kBricks, layer.step, kBisections);
    return traceVolume(layer.volume, ray, layer.isovalue, t_min, t_max, kBricks);
}

// Unit, world axes, towards the viewer. Where the gradient vanishes the surface faces the viewer.
vec3 surfaceNormal(VolumeParams volume, VolumeHit hit, vec3 direction) {
    vec3 gradient;
    if (kSplineNormals) {
        gradient = splineGradient(volume, hit.cell, hit.at);
    } else {
        float c[8];
        cellCorners(volume, hit.cell, 0.0, c);
        gradient = cellGradient(c, hit.at);
    }
    const vec3 normal = worldGradient(volume, gradient);
    const float largest = max(abs(normal.x), max(abs(normal.y), abs(normal.z)));
    if (!(largest > 0.0)) return -direction;
    const vec3 unit = normalize(normal / largest);
    return dot(unit, direction) > 0.0 ? -unit : unit;
}
