// Input and output of shaders/test/whole_numbers.comp, seen by GLSL and C++.
#ifndef RADIATA_TEST_WHOLE_NUMBERS_IO
#define RADIATA_TEST_WHOLE_NUMBERS_IO
#include "shaders/shared/interop.glsl"
SHADER_NAMESPACE_BEGIN

struct WholeNumbersInput {
    uint at;
    uint width;
    float x;
    vec3 colour;
};
STATIC_SIZE(WholeNumbersInput, 24);

struct WholeNumbersOutput {
    uint column;
    uint row;
    int number;
    uint colour;
};
STATIC_SIZE(WholeNumbersOutput, 16);

SHADER_NAMESPACE_END
#endif
