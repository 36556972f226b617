// The second glyphs of a layer, drawn as a homogeneous medium; and what of them lies before each pixel's surface.
#ifndef RADIATA_SHARED_UNCERTAINTY
#define RADIATA_SHARED_UNCERTAINTY
#include "shaders/shared/glyph.glsl"
SHADER_NAMESPACE_BEGIN

struct UncertaintyParams {
    GlyphLayerParams glyphs;
    vec3 emission;     // linear RGB
    float extinction;  // per mm
};
STATIC_SIZE(UncertaintyParams, 144);

// One per pixel, summed over layers. 16 bytes.
struct Medium {
    vec3 weighted_emission;  // optical depth times emission
    float optical_depth;
};
STATIC_SIZE(Medium, 16);

SHADER_NAMESPACE_END
#endif
