// Inputs of shaders/test/shading.comp, seen by GLSL and C++.
#ifndef RADIATA_TEST_SHADING_IO
#define RADIATA_TEST_SHADING_IO
#include "shaders/shared/interop.glsl"
SHADER_NAMESPACE_BEGIN

struct ShadingInput {
    vec3 base;
    float roughness;
    vec3 normal;
    float irradiance;
    vec3 viewer;
    float ambient;
    vec3 light;
    float pad;
};
STATIC_SIZE(ShadingInput, 64);

struct ShadingOutput {
    vec3 radiance;
    vec3 srgb;    // of `base`
    vec3 linear;  // of `base`, taken as sRGB
    vec3 line;    // of a line along `normal`, lit by one light
    vec3 phong;
    vec3 lambert;
    float ambient;
};
STATIC_SIZE(ShadingOutput, 76);

SHADER_NAMESPACE_END
#endif
