// Input and output of shaders/test/raster_codes.comp, seen by GLSL and C++.
#ifndef RADIATA_TEST_RASTER_CODES_IO
#define RADIATA_TEST_RASTER_CODES_IO
#include "shaders/shared/interop.glsl"
SHADER_NAMESPACE_BEGIN

struct RasterCodesInput {
    float t;
    vec3 normal;
};
STATIC_SIZE(RasterCodesInput, 16);

struct RasterCodesOutput {
    float depth;
    float t;  // from that depth
    vec2 pair;
    vec3 normal;  // from that pair
};
STATIC_SIZE(RasterCodesOutput, 28);

SHADER_NAMESPACE_END
#endif
