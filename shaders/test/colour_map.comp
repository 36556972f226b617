// The colour map function over values; the map is the shared values.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/test/function.glsl"
#include "shaders/common/colour_map.glsl"

struct ColourInput {
    float value;
    float low;
    float high;
};

FUNCTION_OVER(ColourInput, vec3)

vec3 function(ColourInput x) {
    return mappedColour(ColourTable(uint64_t(push.shared_values)), x.value, x.low, x.high);
}

FUNCTION_MAIN
