// Input of shaders/test/fiblet.comp, seen by GLSL and C++.
#ifndef RADIATA_TEST_FIBLET_IO
#define RADIATA_TEST_FIBLET_IO
#include "shaders/shared/fiblet.glsl"
SHADER_NAMESPACE_BEGIN

// Which point of a fiblet.
struct FibletPointInput {
    FibletHead head;
    uint first_word;  // of the fiblet's codes, among the shared values
    uint point;
};
STATIC_SIZE(FibletPointInput, 28);

SHADER_NAMESPACE_END
#endif
