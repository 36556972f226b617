// Evaluates the generated SH code over an array of directions. Shared values: the coefficients.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/test/function.glsl"
#include "sh_basis.glsl"

struct ShValues {
    vec4 slope_and_value;
    float even_and_odd;
};

FUNCTION_OVER(vec3, ShValues)

ShValues function(vec3 direction) {
    float c[SH_COUNT];
    for (int i = 0; i < SH_COUNT; ++i) c[i] = push.shared_values.value[i];
    const vec2 parts = shEvaluate(c, direction);
    return ShValues(shEvaluateGradient(c, direction), parts.x + parts.y);
}

FUNCTION_MAIN
