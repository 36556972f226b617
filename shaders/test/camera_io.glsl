// Inputs and outputs of shaders/test/camera_rays.comp and pole_table.comp, seen by GLSL and C++.
#ifndef RADIATA_TEST_CAMERA_IO
#define RADIATA_TEST_CAMERA_IO
#include "shaders/shared/frame.glsl"
SHADER_NAMESPACE_BEGIN

struct CameraInput {
    CameraRays rays;
    vec2 size;   // of the picture, pixels
    vec2 point;  // pixels
};
STATIC_SIZE(CameraInput, 112);

// As PixelRay in shaders/common/camera_rays.glsl.
struct CameraOutput {
    vec3 origin;
    vec3 direction;
    float first;
    float last;
};
STATIC_SIZE(CameraOutput, 32);

struct PoleInput {
    CameraRays rays;
    vec3 centre;  // of the glyph, relative to the reference point
};
STATIC_SIZE(PoleInput, 108);

SHADER_NAMESPACE_END
#endif
