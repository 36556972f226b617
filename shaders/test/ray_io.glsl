// Rays against one glyph, and what a solver says; seen by GLSL and C++.
#ifndef RADIATA_TEST_RAY_IO
#define RADIATA_TEST_RAY_IO
#include "shaders/shared/interop.glsl"
SHADER_NAMESPACE_BEGIN

struct RayInput {
    vec3 origin;  // relative to the glyph's centre
    float t_min;
    vec3 direction;
    uint both_lobes;
};
STATIC_SIZE(RayInput, 32);

struct RayOutput {
    float t;
    float amplitude;  // 0: no hit
    uint steps;
    uint count;  // polynomial: of all hits; march: 1 if it gave up
    vec3 direction;  // unit, from the centre to the hit; the polynomial leaves it 0
};
STATIC_SIZE(RayOutput, 28);

SHADER_NAMESPACE_END
#endif
