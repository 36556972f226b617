// Fourier coefficients of the circles of an array of rays.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/test/function.glsl"
#include "shaders/test/ray_io.glsl"
#include "sh_basis.glsl"
#include "circle.glsl"

struct Circle {
    vec3 e;
    vec2 F[CIRCLE_HARMONICS + 1];
};

FUNCTION_OVER(RayInput, Circle)

#include "shaders/test/glyph_circle.glsl"

Circle function(RayInput x) {
    Circle circle;
    circle.e = rayPlane(x.origin, x.direction).e;
    rayCircle(x.direction, circle.e, circle.F);
    return circle;
}

FUNCTION_MAIN
