// Inputs of shaders/test/fibre.comp, seen by GLSL and C++.
#ifndef RADIATA_TEST_FIBRE_IO
#define RADIATA_TEST_FIBRE_IO
#include "shaders/shared/fiblet_draw.glsl"
SHADER_NAMESPACE_BEGIN

struct FibreInput {
    FibletView view;
    vec3 origin;  // of the ray
    float radius;
    vec3 direction;
    float nearest;
    vec3 start;  // of the capsule; a point to be projected
    float depth;
    vec3 along;
    float pad;
};
STATIC_SIZE(FibreInput, 176);

struct FibreOutput {
    float capsule;       // parameter of the hit
    vec3 normal;
    uint order;          // of the depth
    float ordered;       // the depth from its order
    vec3 line_tangent;   // of `direction`, through 32 bits
    vec3 tube_tangent;   // of `along`
    vec3 tube_normal;    // of the hit's normal
    float column;        // of `start`
    float row;
    float eye_depth;
    uint seen;           // footprint of the box from start to start + along
    int first_column;
    int first_row;
    int last_column;
    int last_row;
    float nearest;
};
STATIC_SIZE(FibreOutput, 96);

SHADER_NAMESPACE_END
#endif
