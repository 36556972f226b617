// Transparent layers of any kind, composed from the front: what each has beside its own parameters.
#ifndef RADIATA_SHARED_PEEL
#define RADIATA_SHARED_PEEL
#include "shaders/shared/interop.glsl"
SHADER_NAMESPACE_BEGIN

// One entry per layer of the scene; 0 where it is not a transparent layer of that kind.
struct PeelParams {
    uint64_t fibres[8];     // FibletLayerParams
    uint64_t glyphs[8];     // Surface[pixels]: the layer's nearest glyphs; nobody once they are composed
    uint64_t crossings[8];  // float[pixels]: of an isosurface, the ray's parameter at the crossing composed last
    uint64_t rest;          // float[pixels]: while moving, what all layers but fibres let through
    uint more;              // pixels through which more than half an 8-bit step shines; written by the device
    uint pad;
};
STATIC_SIZE(PeelParams, 208);

SHADER_NAMESPACE_END
#endif
