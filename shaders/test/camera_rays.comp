// Runs camera_rays.glsl over an array of picture points.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/test/function.glsl"
#include "shaders/test/camera_io.glsl"
#include "shaders/common/camera_rays.glsl"

FUNCTION_OVER(CameraInput, CameraOutput)

CameraOutput function(CameraInput x) {
    const PixelRay ray = pixelRay(x.rays, x.size, x.point);
    return CameraOutput(ray.origin, ray.direction, ray.near, ray.far);
}

FUNCTION_MAIN
