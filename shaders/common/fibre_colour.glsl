// Base colour of a fibre, linear RGB, before light. kFibreColours has a bit for each way that some layer of the scene uses.
#include "shaders/shared/fiblet_draw.glsl"
#include "shaders/common/fibre_directions.glsl"
#include "shaders/common/fiblet_heads.glsl"
#include "shaders/common/fiblet_places.glsl"

layout(constant_id = 5) const uint kFibreColours = 1u;
layout(constant_id = 15) const uint kPagedLayers = 0u;  // bit of each layer of fibres that is not all on the device

layout(buffer_reference, scalar) readonly buffer StateBuffer { uint at[]; };
layout(buffer_reference, scalar) readonly buffer RangeBuffer { vec2 at[]; };
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

// Mean of the values at a segment's two points, or COLOUR_NO_VALUE where one has none.
float pointValue(LayerLook look, uint who) {
    const uint fiblet = who >> FIBLET_SEGMENT_BITS, first = 64u * fiblet + (who & ((1u << FIBLET_SEGMENT_BITS) - 1u));
    uvec2 bytes;
    for (uint i = 0u; i < 2u; ++i) {
        bytes[i] = StateBuffer(look.values).at[(first + i) >> 2u] >> (8u * ((first + i) & 3u)) & 0xffu;
    }
    if (max(bytes.x, bytes.y) == 255u) return COLOUR_NO_VALUE;
    const vec2 range = RangeBuffer(look.point_ranges).at[fiblet];
    return range.x + (range.y - range.x) * (float(bytes.x + bytes.y) / 508.0);
}

// Trilinear in the layer's grid; beyond it, that of the nearest point in it. \param place  from the rays' reference point, mm
float gridDistance(LayerLook look, vec3 place) {
    const vec3 node = clamp((place - look.grid_origin) / look.grid_step, vec3(0.0), vec3(look.grid_size - 1));
    const ivec3 low = min(ivec3(node), look.grid_size - 2);
    const vec3 share = node - vec3(low);
    float sum = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        const ivec3 bit = ivec3(corner & 1, corner >> 1 & 1, corner >> 2);
        const vec3 part = mix(1.0 - share, share, vec3(bit));
        const ivec3 at = low + bit;
        sum += part.x * part.y * part.z * ValueBuffer(look.values).at[(at.z * look.grid_size.y + at.y) * look.grid_size.x + at.x];
    }
    return sum;
}

// Of a fiblet that was drawn. \param heads  FibletHead[], or the FibletPlaces of a layer that is not all on the device; of such
// a layer a pick draws more than stays, and does not look at what depends on the fibre.
FibletHead headOf(uint64_t heads, bool paged, uint fiblet) {
    if (!paged) return HeadBuffer(heads).at[fiblet];
    PlaceBuffer places = PlaceBuffer(heads);
    const FibletPlace place = places.at[fiblet / FIBLET_PAGE];
    if (!fibletHeld(place, fiblet % FIBLET_PAGE)) return FibletHead(0u, 0u, 0u, 0u, 0u);
    return HeadBuffer(places.head.heads).at[fibletHeldAt(place, fiblet % FIBLET_PAGE)];
}

// \param layer  its number \param place  of the hit, from the rays' reference point, mm \param direction  in the surface buffer: of a line its tangent
// \param pixel  number of the pixel. \param line  whether it is a line, not a tube. \param light  factor on its light
vec3 fibreColour(LayerLook look, uint layer, uint who, vec3 place, vec3 direction, uint pixel, out bool line, out float light) {
    const uint without = 1u << FIBRE_COLOUR_UNIFORM | 1u << FIBRE_COLOUR_DIRECTION | 1u << FIBRE_COLOUR_POINT | 1u << FIBRE_COLOUR_DISTANCE;
    uint fibre = 0u, state = FIBRE_SHOWN;
    if (look.states != 0ul || (kFibreColours & ~without) != 0u) {
        fibre = headOf(look.instances, (kPagedLayers >> layer & 1u) != 0u, who >> FIBLET_SEGMENT_BITS).fibre;
    }
    if (look.states != 0ul) state = StateBuffer(look.states).at[fibre >> 2u] >> (8u * (fibre & 3u)) & 0xffu;
    line = look.tubes == 0u || (look.tubes == 2u && state != FIBRE_SELECTED);
    light = state == FIBRE_SELECTED ? 1.0 : look.unselected;
    if (fibresBy(look, FIBRE_COLOUR_UNIFORM)) return look.uniform_colour;
    if (fibresBy(look, FIBRE_COLOUR_OWN)) return numberColour(fibre);
    if (fibresBy(look, FIBRE_COLOUR_DIRECTION)) {
        if (!line) direction = tubeTangent(DirectionBuffer(look.tangents).at[pixel].y);
        return linearFromSrgb(abs(direction));
    }
    if (fibresBy(look, FIBRE_COLOUR_ENDS)) return linearFromSrgb(abs(lineTangent(StateBuffer(look.values).at[fibre])));
    float value;
    if (fibresBy(look, FIBRE_COLOUR_POINT)) value = pointValue(look, who);
    else if (fibresBy(look, FIBRE_COLOUR_DISTANCE)) value = gridDistance(look, place);
    else value = ValueBuffer(look.values).at[fibre];
    if (value >= COLOUR_NO_VALUE) return kFibreGrey;
    if (fibresBy(look, FIBRE_COLOUR_GROUP)) return numberColour(uint(value));
    return mappedColour(ColourTable(look.map), value, look.range_low, look.range_high);
}
