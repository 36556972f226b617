// What drawing a layer of fiblets reads beside the fiblets themselves (shaders/shared/fiblet.glsl): the camera as a projection,
// pictures of depth and fibre, visibility, cuts.
#ifndef RADIATA_SHARED_FIBLET_DRAW
#define RADIATA_SHARED_FIBLET_DRAW
#include "shaders/shared/interop.glsl"
#include "shaders/shared/fiblet.glsl"
SHADER_NAMESPACE_BEGIN

// Who is seen in a pixel: fiblet << FIBLET_SEGMENT_BITS | segment, segment i between the fiblet's points i and i + 1.
#ifdef __cplusplus
constexpr uint FIBLET_SEGMENT_BITS = 6;
constexpr uint FIBLET_NOBODY = 0xffffffffU;
constexpr uint FIBLET_CUTS_MAX = 6;
constexpr uint FIBRE_SHOWN = 0;
constexpr uint FIBRE_HIDDEN = 1;
constexpr uint FIBRE_SELECTED = 2;
#else
#define FIBLET_SEGMENT_BITS 6u
#define FIBLET_NOBODY 0xffffffffu
#define FIBLET_CUTS_MAX 6u
#define FIBRE_SHOWN 0u
#define FIBRE_HIDDEN 1u
#define FIBRE_SELECTED 2u
#endif

// One sample's rays as a projection of points q relative to the reference point. With the nearness w = 1 + d * inverse_distance,
// d = dot(forward, q), q stands at column dot(right, q) / w + centre.x and row centre.y - dot(up, q) / w of the whole picture,
// in which pixel i reaches from i to i + 1 and is seen through i + 1/2.
struct FibletView {
    vec3 right;  // pixels per mm on the reference plane
    float inverse_distance;
    vec3 up;
    float near_depth;  // least d that is seen; 1e-5 of the distance before the eye at least
    vec3 forward;
    float far_depth;
    vec3 reference_high;  // reference point minus the fiblets' origin, as a sum of two floats
    float line_width;     // pixels, whole
    vec3 reference_low;
    float tube_radius;  // mm
    vec2 centre;
    int window_x;  // first pixel of the window of the whole picture that is drawn
    int window_y;
    int width;  // of the window
    int height;
    float rounding;  // mm that float positions and depths may be off
    uint pad;
};
STATIC_SIZE(FibletView, 112);

// Segments are seen where dot(normal, p) <= offset, p from the fiblets' origin, mm.
struct FibletCut {
    vec3 normal;
    float offset;
};
STATIC_SIZE(FibletCut, 16);

struct FibletLayerParams {
    FibletView view;
    FibletCut cuts[6];
    FibletCodec codec;
    uint64_t heads;       // FibletHead[fiblets]
    uint64_t pages;       // FibletPage[pages]
    uint64_t codes;       // uint[]
    uint64_t boxes;       // FibletBox[fiblets]
    uint64_t states;      // FIBRE_SHOWN, ... of each fibre, four bytes to a word; 0: all are shown
    uint64_t segments;    // uint64_t[fiblets]: bit i says that segment i is shown; 0: all are
    uint64_t peeled;      // uint64_t[pixels]: of transparent layers, the word that was composed last; 0: none; while counted, what is opaque
    uint64_t fragments;   // uint[pixels]: of transparent layers while moving, segments before what is opaque
    uint64_t inside;      // one bit per pixel: it counts for what is found
    uint64_t found;       // one bit per fibre: it is drawn through such a pixel
    uint64_t words;       // uint64_t[pixels]: order of depths << 32 | who
    uint64_t tangents;    // uint64_t[pixels]: direction << 32 | who
    uint64_t visible;     // one bit per fiblet: won a pixel of the latest picture
    uint64_t list;        // uint[fiblets]: those to draw, in order of finding
    uint64_t page_order;  // uint[pages]
    uint64_t pyramid;     // uint[]: farthest order of depths of 2x2, 4x4, ... pixels, level after level
    uint64_t counts;      // FibletCounts
    uint fiblet_count;
    uint page_count;
    uint layer;
    uint pyramid_levels;
    uint64_t next;    // uint[fiblets]: that goes on along the fibre, or FIBLET_NOBODY; 0: nobody looks at it
    float detail_px;  // pixels that lines may be off
    float end_slack;  // mm that a fiblet's end may be from the start of the next
    uint detail_segments;  // that follow each other and may become one line: a power of two; 0: none do
    uint list_size;        // fiblets that have room in the list
    uint64_t places;  // FibletPlaces of a tractogram beyond the memory budget; 0: all of it lies in its own order
    uint64_t cut_front;  // uint[pixels]: order of depths of the cutting mesh's nearest front face; FIBLET_NOBODY: none
    uint64_t cut_back;   // uint[pixels]: of its farthest back face; 0: none
    uint64_t chain;      // ChainSlot[slots][pixels]: of transparent layers, the nearest that are not composed
    uint64_t limits;     // uint[pixels]: order of depths behind which chains keep nothing
};
STATIC_SIZE(FibletLayerParams, 496);

// A segment that a pixel of a transparent layer keeps.
struct ChainSlot {
    uint64_t word;   // as in `words`
    uint64_t named;  // as in `tangents`
};
STATIC_SIZE(ChainSlot, 16);

// Where the fiblets of a page lie that are in device memory, of a tractogram beyond the memory budget: all, or those of the subset.
struct FibletPlace {
    uint first_head;  // of heads and boxes
    uint first_word;  // what the heads' codes are counted from
    uint held_low;    // bit i: fiblet i of the page is there, behind those of lower bits
    uint held_high;   // and fiblet 32 + i
};
STATIC_SIZE(FibletPlace, 16);

// Stands before the FibletPlace of each page.
struct FibletPlaces {
    uint64_t heads;  // FibletHead[]
    uint64_t pad;
};
STATIC_SIZE(FibletPlaces, 16);

// A decoded fiblet on its way to the rasteriser.
struct FibletSlot {
    uint fiblet;
    uint segments;
    vec4 eye[64];  // points as fibletEyePoint() has them; segments + 1 are set
};
STATIC_SIZE(FibletSlot, 1032);

// A line that stands for some segments of a fiblet, on its way to the rasteriser.
struct FibletListedLine {
    vec4 from;  // as fibletEyePoint() has them
    vec4 to;
    uint who;    // the first of the segments
    uint count;  // of segments
};
STATIC_SIZE(FibletListedLine, 40);

// A point of a fibre without compression. Of the last point of a fibre `who` is that of the point before.
struct FibreVertex {
    vec3 point;  // from the fiblets' origin, mm
    uint who;    // the segment that begins here
};
STATIC_SIZE(FibreVertex, 16);

// Written by the device.
struct FibletCounts {
    uint listed;    // fiblets in the list
    uint pages;     // that were looked into
    uint repaired;  // pixels whose tangent another fiblet had overwritten
    uint more;      // pixels of a transparent layer that show what is behind the segment composed last
    uint error_px;  // bits of a float: largest bound on how far a simplified line is off
};
STATIC_SIZE(FibletCounts, 20);

SHADER_NAMESPACE_END
#endif
