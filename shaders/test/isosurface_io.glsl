// Inputs and outputs of shaders/test/cubic.comp, volume_trace.comp and volume_gradient.comp, seen by GLSL and C++.
#ifndef RADIATA_TEST_ISOSURFACE_IO
#define RADIATA_TEST_ISOSURFACE_IO
#include "shaders/shared/isosurface.glsl"
SHADER_NAMESPACE_BEGIN

// A chord through a cell.
struct CubicInput {
    float corners[8];  // x fastest, then y, then z
    float isovalue;
    vec3 from;  // in [0, 1]^3
    vec3 to;
};
STATIC_SIZE(CubicInput, 60);

struct VolumeRay {
    VolumeParams volume;
    ivec3 base;
    vec3 origin;
    vec3 direction;
    float isovalue;
    float t_min;
    float t_max;
};
STATIC_SIZE(VolumeRay, 152);

// As VolumeHit in shaders/isosurface/trace_volume.glsl.
struct VolumeRayHit {
    float t;
    ivec3 cell;
    vec3 at;
    uint inside;
    uint steps;
};
STATIC_SIZE(VolumeRayHit, 36);

struct GradientInput {
    VolumeParams volume;
    ivec3 cell;
    vec3 at;
};
STATIC_SIZE(GradientInput, 128);

struct GradientOutput {
    vec3 spline;
    vec3 trilinear;
    vec3 spline_world;  // per mm along world axes
};
STATIC_SIZE(GradientOutput, 36);

SHADER_NAMESPACE_END
#endif
