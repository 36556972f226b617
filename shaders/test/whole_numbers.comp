// Runs whole_number.glsl, pixel_place.glsl and the packing of srgb.glsl.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/test/function.glsl"
#include "shaders/test/whole_numbers_io.glsl"
#include "shaders/common/pixel_place.glsl"
#include "shaders/common/srgb.glsl"

FUNCTION_OVER(WholeNumbersInput, WholeNumbersOutput)

WholeNumbersOutput function(WholeNumbersInput x) {
    const ivec2 place = pixelPlace(x.at, x.width);
    return WholeNumbersOutput(uint(place.x), uint(place.y), wholeNumber(x.x), packedColour(x.colour));
}

FUNCTION_MAIN
