// Fiblets: pieces of at most 63 segments of a streamline, each decoded on its own (Schertzer et al. 2022, Sec. 3.2, with the
// changes that docs/formats/fiblet.md gives reasons for). Heads and codes lie apart, so that culling reads 20 bytes a fiblet; fiblets
// are in Morton order, and each FIBLET_PAGE of them in a row are a page with a box.
#ifndef RADIATA_SHARED_FIBLET
#define RADIATA_SHARED_FIBLET
#include "shaders/shared/interop.glsl"
SHADER_NAMESPACE_BEGIN

#ifdef __cplusplus
constexpr uint FIBLET_SEGMENTS = 63;
constexpr uint FIBLET_PAGE = 64;
constexpr uint FIBLET_CAPS = 16;
constexpr uint FIBLET_BOX_STEPS = 1023;
#else
#define FIBLET_SEGMENTS 63
#define FIBLET_PAGE 64
#define FIBLET_CAPS 16
#define FIBLET_BOX_STEPS 1023
#endif

// Bits from the lowest:
//   place0     cell x: 20, cell y: its lower 12
//   place1     cell y: its upper 8, cell z: 20, cap: 4 (index into FibletCodec.cap_ratio)
//   direction  of the first segment: 16 + 16, signed, the octahedron |x| + |y| + |z| = 32767 seen along x (y low, z high)
//   fibre      number of the fibre
//   shape      segments: 6 (0: a fibre of one point), width: 2 (4, 6, 8, 16 bits a code), last of its fibre: 1, shortened last
//              segment: 1, codes' place in the page: 10 (in pairs of words), number within the fibre: 12
// Point 0 is at cell * cell_mm from the set's origin. Fiblet n of a fibre starts at the fibre's point 63 n and ends where the next starts,
// up to the codec's error. Codes: segments - 1 of them, lowest bits first, from word FibletPage.first_word + 2 * place on; behind
// them, if the last segment is shortened, 16 bits with its length as a fraction of the step in units of 1 / 65535.
struct FibletHead {
    uint place0;
    uint place1;
    uint direction;
    uint fibre;
    uint shape;
};
STATIC_SIZE(FibletHead, 20);

// Box of all decoded points of a page, mm from the set's origin.
struct FibletPage {
    vec3 low;
    uint first_word;  // where the page's codes begin
    vec3 high;
    uint count;       // fiblets; FIBLET_PAGE but for the last page
};
STATIC_SIZE(FibletPage, 32);

// Box of a fiblet's decoded points: each corner three times 10 bits, x lowest, in steps of 1 / FIBLET_BOX_STEPS of its page's box, rounded outwards.
// The upper 2 bits of `low` choose a diagonal of the box, from its lower end in x on: bit 0 that it falls in y, bit 1 that it falls in z.
// With the upper 2 bits of `high` as n, all points are within 2^-(n + 2) of its length from it; n = 0: nothing is known.
// Made when a set is loaded; not part of the file.
struct FibletBox {
    uint low;
    uint high;
};
STATIC_SIZE(FibletBox, 8);

// What a set's fiblets have in common.
struct FibletCodec {
    float cell_mm;                 // of point 0
    float step_mm;                 // length of every segment but shortened last ones
    float cap_ratio[FIBLET_CAPS];  // 1 - cos(largest turn at a point), up to 2
};
STATIC_SIZE(FibletCodec, 72);

SHADER_NAMESPACE_END
#endif
