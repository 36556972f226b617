// Points on level sets: normals, and where rays from a point may begin.
#ifndef RADIATA_ISOSURFACE_LEVEL_SET
#define RADIATA_ISOSURFACE_LEVEL_SET
#include "shaders/isosurface/trace_volume.glsl"

// Grid coordinates cell + at, at in [0, 1]^3 for points inside the volume.
struct GridPoint {
    ivec3 cell;
    vec3 at;
};

GridPoint gridPoint(VolumeParams volume, ivec3 base, vec3 offset) {
    const ivec3 cell = clamp(base + ivec3(floor(offset)), ivec3(0), volume.size - 2);
    return GridPoint(cell, offset - vec3(cell - base));
}

// Trilinear, less the isovalue; far below for points outside the volume and in cells without numbers.
float levelAt(VolumeParams volume, GridPoint p, float isovalue) {
    if (any(lessThan(p.at, vec3(-1e-6))) || any(greaterThan(p.at, vec3(1.0 + 1e-6)))) return -VOLUME_NO_VALUE;
    float c[8];
    if (!cellCorners(volume, p.cell, isovalue, c)) return -VOLUME_NO_VALUE;
    return cellValue(c, clamp(p.at, 0.0, 1.0));
}

// Unit, world, towards lower values; 0 where the smoothed gradient vanishes.
vec3 outwardNormal(VolumeParams volume, GridPoint p) {
    const vec3 gradient = worldGradient(volume, splineGradient(volume, p.cell, clamp(p.at, 0.0, 1.0)));
    const float squared = dot(gradient, gradient);
    return squared > 1e-36 ? -gradient * inversesqrt(squared) : vec3(0.0);
}

// How far from a surface a ray begins along the normal, shortest voxel edges; four times as far while that is not outside.
const float kSurfaceOffset = 0.02;

// \return false if the point cannot be left: it is buried in noise
bool liftOff(VolumeParams volume, GridPoint p, vec3 n, float isovalue, out GridRay ray) {
    const vec3 step = gridVector(volume, n) * volume.voxel_mm;
    ray.direction = vec3(1.0, 0.0, 0.0);
    for (float offset = kSurfaceOffset; offset < 1.0; offset *= 4.0) {
        ray.base = p.cell;
        ray.origin = p.at + offset * step;
        if (levelAt(volume, gridPoint(volume, ray.base, ray.origin), isovalue) < 0.0) return true;
    }
    return false;
}

#endif
