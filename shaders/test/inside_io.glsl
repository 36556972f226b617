// Parts of rays, and how much of them is inside of one glyph; seen by GLSL and C++.
#ifndef RADIATA_TEST_INSIDE_IO
#define RADIATA_TEST_INSIDE_IO
#include "shaders/shared/interop.glsl"
SHADER_NAMESPACE_BEGIN

struct InsideInput {
    vec3 origin;  // relative to the glyph's centre
    float begin;
    vec3 direction;
    float end;
    uint both_lobes;
};
STATIC_SIZE(InsideInput, 36);

struct InsideOutput {
    float length;
    uint steps;
    uint capped;
};
STATIC_SIZE(InsideOutput, 12);

SHADER_NAMESPACE_END
#endif
