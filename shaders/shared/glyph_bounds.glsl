// What samples of a glyph's function showed, from which server/build/bounds_certificate makes bounds.
#ifndef RADIATA_SHARED_GLYPH_BOUNDS
#define RADIATA_SHARED_GLYPH_BOUNDS
#include "shaders/shared/interop.glsl"
SHADER_NAMESPACE_BEGIN

// Of a function f over directions d; each value is the largest found and at least 0, but f_max, which may be negative.
struct GlyphExtremes {
    float f_max;
    float f_low;         // of -f
    vec3 positive_up;    // of d_a f where f > 0
    vec3 positive_down;  // of -d_a f there
    vec3 negative_up;    // of d_a |f| where f < 0
    vec3 negative_down;  // of -d_a |f| there
};
STATIC_SIZE(GlyphExtremes, 56);

SHADER_NAMESPACE_END
#endif
