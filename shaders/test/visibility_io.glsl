// Inputs and outputs of the wrappers around the sampling of light (projected_cap.comp) and the occlusion march (occlusion.comp).
#ifndef RADIATA_TEST_VISIBILITY_IO
#define RADIATA_TEST_VISIBILITY_IO
#include "shaders/shared/interop.glsl"
SHADER_NAMESPACE_BEGIN

struct CapInput {
    vec3 light;
    float sine;    // of the cap's angular radius
    vec3 normal;
    float cosine;
    uint index;    // of the ray
    uint pixel;
};
STATIC_SIZE(CapInput, 40);

struct CapOutput {
    vec3 direction;
    float area;       // projected solid angle
    vec3 hemisphere;  // cosineHemisphereSample of the same point
    vec2 point;       // raySample
};
STATIC_SIZE(CapOutput, 36);

struct OcclusionInput {
    vec3 origin;     // relative to the glyph's centre, units of amplitude
    uint both_lobes;
    vec3 direction;
    float t_max;     // 1e30: endless
    uint on_surface; // the origin lies on the glyph up to rounding
};
STATIC_SIZE(OcclusionInput, 36);

struct OcclusionOutput {
    uint blocked;
    uint capped;
};
STATIC_SIZE(OcclusionOutput, 8);

SHADER_NAMESPACE_END
#endif
