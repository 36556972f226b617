// Normals of one glyph over an array of directions. Shared values: the coefficients.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/test/function.glsl"
#include "sh_basis.glsl"
#include "shaders/common/glyph_normal.glsl"

FUNCTION_OVER(vec3, vec3)

vec3 function(vec3 direction) {
    float c[SH_COUNT];
    for (int i = 0; i < SH_COUNT; ++i) c[i] = push.shared_values.value[i];
    return glyphNormal(shEvaluateGradient(c, direction), direction);
}

FUNCTION_MAIN
