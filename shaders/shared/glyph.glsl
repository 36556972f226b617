// One glyph layer on the device.
#ifndef RADIATA_SHARED_GLYPH
#define RADIATA_SHARED_GLYPH
#include "shaders/shared/interop.glsl"
SHADER_NAMESPACE_BEGIN

// A glyph that is shown. Positions are mm relative to the scene's centre.
struct GlyphInstance {
    vec3 centre_high;  // centre = high + low, so that close-ups keep their precision
    float scale;       // mm per unit of amplitude
    vec3 centre_low;
    float radius;      // certified largest distance from the centre, mm
    vec3 box_min;      // certified box relative to the centre, mm
    uint slot;         // of the dataset's coefficients
    vec3 box_max;
    uint pad;
};
STATIC_SIZE(GlyphInstance, 64);

struct GlyphLayerParams {
    uint64_t instances;     // GlyphInstance[count]
    uint64_t coefficients;  // float[slots * stride]
    uint64_t tables;        // pole-frame tables, float[count * POLE_TABLE_COUNT], or 0
    uint64_t bvh_nodes;     // BvhNode[], or 0
    uint64_t bvh_order;     // uint[]
    uint64_t acceleration;  // address of the ray-query structure, or 0
    uint64_t tile_lists;    // uint[tile_entries], or 0
    uint64_t tile_ranges;   // uvec2[tiles]: first entry, count
    uint64_t sun_tables;    // like tables, for rays towards the light, or 0
    uint64_t sun_lists;     // like tile_lists and tile_ranges, for boxes along the light's direction, or 0
    uint64_t sun_ranges;
    uint64_t tensors;       // of tensor layers: float[slots * components], or of ellipsoids float[count * 6]; or 0
    uint count;
    uint stride;      // coefficients per slot
    uint used;        // coefficients that are drawn (band limit)
    uint both_lobes;  // negative lobes shown
    uint layer;
    uint pad0;
    uint pad1;  // to a multiple of 16, the alignment that a buffer reference promises
    uint pad2;
};
STATIC_SIZE(GlyphLayerParams, 128);

SHADER_NAMESPACE_END
#endif
