// Runs trace_volume.glsl over an array of rays.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/test/function.glsl"
#include "shaders/test/isosurface_io.glsl"
#include "shaders/isosurface/trace_volume.glsl"

layout(constant_id = 1) const bool kBricks = true;

FUNCTION_OVER(VolumeRay, VolumeRayHit)

VolumeRayHit function(VolumeRay x) {
    const GridRay ray = GridRay(x.base, x.origin, x.direction);
    const VolumeHit hit = traceVolume(x.volume, ray, x.isovalue, x.t_min, x.t_max, kBricks);
    return VolumeRayHit(hit.t, hit.cell, hit.at, hit.inside ? 1u : 0u, hit.steps);
}

FUNCTION_MAIN
