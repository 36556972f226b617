// Runs the gradients of volume.glsl over an array of points.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/test/function.glsl"
#include "shaders/test/isosurface_io.glsl"
#include "shaders/common/volume.glsl"

FUNCTION_OVER(GradientInput, GradientOutput)

GradientOutput function(GradientInput x) {
    float c[8];
    cellCorners(x.volume, x.cell, 0.0, c);
    const vec3 spline = splineGradient(x.volume, x.cell, x.at);
    return GradientOutput(spline, cellGradient(c, x.at), worldGradient(x.volume, spline));
}

FUNCTION_MAIN
