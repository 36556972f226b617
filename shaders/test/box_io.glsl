// Input of shaders/test/box.comp, seen by GLSL and C++.
#ifndef RADIATA_TEST_BOX_IO
#define RADIATA_TEST_BOX_IO
#include "shaders/shared/interop.glsl"
SHADER_NAMESPACE_BEGIN

struct BoxInput {
    vec3 origin;
    vec3 direction;
    vec3 low;
    vec3 high;
};
STATIC_SIZE(BoxInput, 48);

SHADER_NAMESPACE_END
#endif
