// Runs depth_code.glsl and octahedral.glsl there and back.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/test/function.glsl"
#include "shaders/test/raster_codes_io.glsl"
#include "shaders/common/depth_code.glsl"
#include "shaders/common/octahedral.glsl"

FUNCTION_OVER(RasterCodesInput, RasterCodesOutput)

RasterCodesOutput function(RasterCodesInput x) {
    const float depth = depthOfParameter(x.t);
    const vec2 pair = octahedralOf(x.normal);
    return RasterCodesOutput(depth, parameterOfDepth(depth), pair, vectorOfOctahedral(pair));
}

FUNCTION_MAIN
