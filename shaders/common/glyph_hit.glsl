// What a comparison method says about a ray and a glyph.
#ifndef RADIATA_COMMON_GLYPH_HIT
#define RADIATA_COMMON_GLYPH_HIT

struct GlyphHit {
    float t;
    float amplitude;  // signed f in the direction of the hit; 0: no hit
    uint steps;       // of the method: Newton steps, evaluations of the function
};

#endif
