// Base colour of a hit, linear RGB, before light. By direction: van Almsick et al. 2011, |p / |p|| as an sRGB triple.
// kColourModes has a bit for each way that some layer of the scene uses; the others are not compiled.
#include "shaders/shared/layer_look.glsl"
#include "shaders/common/colour_map.glsl"
#include "shaders/common/srgb.glsl"

layout(constant_id = 2) const uint kColourModes = 1u;

layout(buffer_reference, scalar) readonly buffer ValueBuffer { float at[]; };

bool colouredBy(LayerLook look, uint mode) { return (kColourModes & (1u << mode)) != 0u && look.colour == mode; }

// \param who     glyph instance
// \param offset  from the glyph's centre to the hit, mm
vec3 baseColour(LayerLook look, uint who, vec3 offset) {
    const float squared = max(dot(offset, offset), 1e-30);
    if (colouredBy(look, COLOUR_RADIUS)) {
        return mappedColour(ColourTable(look.map), sqrt(squared), look.range_low, look.range_high);
    }
    if (colouredBy(look, COLOUR_SCALAR)) {
        const float value = ValueBuffer(look.values).at[who];
        if (value >= COLOUR_NO_VALUE) return vec3(0.214);  // sRGB grey 0.5
        return mappedColour(ColourTable(look.map), value, look.range_low, look.range_high);
    }
    if (colouredBy(look, COLOUR_UNIFORM)) return look.uniform_colour;
    return linearFromSrgb(abs(offset) * inversesqrt(squared));
}
