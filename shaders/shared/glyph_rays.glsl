// Rays against one glyph, and all hits of each: what glyph/all_hits.comp reads and writes for picks. Lengths in units of amplitude.
#ifndef RADIATA_SHARED_GLYPH_RAYS
#define RADIATA_SHARED_GLYPH_RAYS
#include "shaders/shared/interop.glsl"
SHADER_NAMESPACE_BEGIN

struct GlyphRay {
    vec3 origin;  // relative to the glyph's centre
    float t_min;  // hits before it are left out
    vec3 direction;  // unit
    uint both_lobes;
};
STATIC_SIZE(GlyphRay, 32);

// Words of 4 bytes of each ray's answer: how many hits, whether the method gave up, steps; then for each hit its t, the signed amplitude,
// and 1 where the ray enters the glyph or 0 where it leaves.
const uint GLYPH_RAY_HEADER = 3u;
const uint GLYPH_RAY_WORDS = 3u;  // of a hit

SHADER_NAMESPACE_END
#endif
