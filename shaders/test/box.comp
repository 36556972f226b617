// Runs box.glsl over an array of rays and boxes.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/test/function.glsl"
#include "shaders/test/box_io.glsl"
#include "shaders/common/box.glsl"

FUNCTION_OVER(BoxInput, vec2)

vec2 function(BoxInput x) { return boxSpan(x.origin, inverseDirection(x.direction), x.low, x.high); }

FUNCTION_MAIN
