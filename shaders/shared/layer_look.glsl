// What the light pass reads of a layer.
#ifndef RADIATA_SHARED_LAYER_LOOK
#define RADIATA_SHARED_LAYER_LOOK
#include "shaders/shared/interop.glsl"
SHADER_NAMESPACE_BEGIN

// Values of LayerLook.colour; bit 1 << value of the light pass's kColourModes says that some layer has it.
// Kinds of layers: the order of model::Layer::content.
#ifdef __cplusplus
constexpr uint LAYER_GLYPHS = 0;
constexpr uint LAYER_TRACTS = 1;
constexpr uint LAYER_SURFACE = 2;
constexpr uint COLOUR_DIRECTION = 0;
constexpr uint COLOUR_RADIUS = 1;
constexpr uint COLOUR_SCALAR = 2;
constexpr uint COLOUR_UNIFORM = 3;
constexpr float COLOUR_NO_VALUE = 3.4e38F;
#else
#define LAYER_GLYPHS 0u
#define LAYER_TRACTS 1u
#define LAYER_SURFACE 2u
#define COLOUR_DIRECTION 0u
#define COLOUR_RADIUS 1u
#define COLOUR_SCALAR 2u
#define COLOUR_UNIFORM 3u
#define COLOUR_NO_VALUE 3.4e38
#endif

// Values of LayerLook.colour of fibres, model::FibreColourMode; bit 1 << value of the light pass's kFibreColours.
#ifdef __cplusplus
constexpr uint FIBRE_COLOUR_DIRECTION = 0;
constexpr uint FIBRE_COLOUR_UNIFORM = 1;
constexpr uint FIBRE_COLOUR_OWN = 2;
constexpr uint FIBRE_COLOUR_GROUP = 3;
constexpr uint FIBRE_COLOUR_COLUMN = 4;
constexpr uint FIBRE_COLOUR_LENGTH = 5;
constexpr uint FIBRE_COLOUR_POINT = 6;
constexpr uint FIBRE_COLOUR_DISTANCE = 7;
constexpr uint FIBRE_COLOUR_ENDS = 8;
#else
#define FIBRE_COLOUR_DIRECTION 0u
#define FIBRE_COLOUR_UNIFORM 1u
#define FIBRE_COLOUR_OWN 2u
#define FIBRE_COLOUR_GROUP 3u
#define FIBRE_COLOUR_COLUMN 4u
#define FIBRE_COLOUR_LENGTH 5u
#define FIBRE_COLOUR_POINT 6u
#define FIBRE_COLOUR_DISTANCE 7u
#define FIBRE_COLOUR_ENDS 8u
#endif

struct LayerLook {
    uint64_t instances;  // GlyphInstance[], or of fibres FibletHead[], or FibletPlaces where not all are on the device
    float opacity;
    uint colour;         // COLOUR_DIRECTION, ...
    uint64_t map;        // vec3[256], linear RGB, or 0
    uint64_t values;     // float[] by instance or fibre, COLOUR_NO_VALUE where there is none, or 0
    vec3 uniform_colour;  // linear RGB
    float range_low;     // of the map: mm, or values
    float range_high;
    uint kind;           // LAYER_GLYPHS, ...; bit 1 << value of the light pass's kLayerKinds says that some layer is of it
    uint64_t states;     // of fibres: FIBRE_SHOWN, ..., or 0
    uint64_t tangents;   // of fibres: what pixels keep of directions, see shaders/fiblet/raster.comp
    uint tubes;          // 0: fibres are lines; 1: tubes; 2: selected ones are tubes
    float unselected;    // factor on the light of fibres that are not selected
    float occlusion_px;  // radius of occlusion in screen space, pixels; 0: none
    float halo_px;       // width of halos; 0: none
    uint64_t point_ranges;  // of fibres coloured per point: vec2[fiblets], value of byte 0 and of 254; `values` has 64 bytes a fiblet
    vec3 grid_origin;       // of fibres coloured by distance: node 0 from the rays' reference point, mm; `values` has the nodes, x fastest
    float grid_step;        // mm
    ivec3 grid_size;        // nodes
    uint grid_pad;
};
STATIC_SIZE(LayerLook, 128);

SHADER_NAMESPACE_END
#endif
