#ifndef RADIATA_COMMON_COLOUR_MAP
#define RADIATA_COMMON_COLOUR_MAP
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require

layout(buffer_reference, scalar) readonly buffer ColourTable { vec3 at[256]; };

// Colour of a value: linear interpolation between the table's entries, which stand for low, ... high in equal steps.
// What lies beyond has the colour of its end. \param low, high  finite, low < high
vec3 mappedColour(ColourTable table, float value, float low, float high) {
    const float place = clamp((value - low) / (high - low), 0.0, 1.0) * 255.0;
    const int below = min(int(place), 254);
    return mix(table.at[below], table.at[below + 1], place - float(below));
}

#endif
