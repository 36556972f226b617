// Base colour of a fibre, linear RGB, before light. kFibreColours has a bit for each way that some layer of the scene uses.
#include "shaders/shared/fiblet_draw.glsl"
#include "shaders/common/fibre_directions.glsl"

layout(constant_id = 5) const uint kFibreColours = 1u;

layout(buffer_reference, scalar) readonly buffer HeadBuffer { FibletHead at[]; };
layout(buffer_reference, scalar) readonly buffer StateBuffer { uint at[]; };
layout(buffer_reference, scalar) readonly buffer DirectionBuffer { uvec2 at[]; };  // who, direction

const vec3 kFibreGrey = vec3(0.214);  // sRGB 0.5

bool fibresBy(LayerLook look, uint mode) { return (kFibreColours & (1u << mode)) != 0u && look.colour == mode; }

// Colours of neighbouring numbers are far apart: hues a golden angle from each other, in three lightnesses.
vec3 numberColour(uint number) {
    const float hue = fract(float(number % 65536u) * 0.61803399);
    const vec3 ramp = clamp(abs(fract(hue + vec3(0.0, 2.0 / 3.0, 1.0 / 3.0)) * 6.0 - 3.0) - 1.0, 0.0, 1.0);
    const float lightness = 0.75 + 0.125 * float(number % 3u);
    return linearFromSrgb(lightness * mix(vec3(1.0), ramp, 0.75));
}

// \param pixel  number of the pixel. \param line  whether it is a line, not a tube. \param light  factor on its light
vec3 fibreColour(LayerLook look, uint who, uint pixel, out bool line, out float light) {
    const uint fibre = HeadBuffer(look.instances).at[who >> FIBLET_SEGMENT_BITS].fibre;
    uint state = FIBRE_SHOWN;
    if (look.states != 0ul) state = StateBuffer(look.states).at[fibre >> 2u] >> (8u * (fibre & 3u)) & 0xffu;
    line = look.tubes == 0u || (look.tubes == 2u && state != FIBRE_SELECTED);
    light = state == FIBRE_SELECTED ? 1.0 : look.unselected;
    if (fibresBy(look, FIBRE_COLOUR_UNIFORM)) return look.uniform_colour;
    if (fibresBy(look, FIBRE_COLOUR_OWN)) return numberColour(fibre);
    if (fibresBy(look, FIBRE_COLOUR_DIRECTION)) {
        const uint bits = DirectionBuffer(look.tangents).at[pixel].y;
        return linearFromSrgb(abs(line ? lineTangent(bits) : tubeTangent(bits)));
    }
    const float value = ValueBuffer(look.values).at[fibre];
    if (value >= COLOUR_NO_VALUE) return kFibreGrey;
    if (fibresBy(look, FIBRE_COLOUR_GROUP)) return numberColour(uint(value));
    return mappedColour(ColourTable(look.map), value, look.range_low, look.range_high);
}
