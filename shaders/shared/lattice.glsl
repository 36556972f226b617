// The illumination lattice of a volume: texels in bricks of 4^3, and the light that they are lit by.
#ifndef RADIATA_SHARED_LATTICE
#define RADIATA_SHARED_LATTICE
#include "shaders/shared/isosurface.glsl"
SHADER_NAMESPACE_BEGIN

// A texel's state: its relative standard error as a half, the number of doublings of its samples plus one (0: it has none), and whether
// there is no surface through it (the smoothed gradient vanishes). What is shown of it says the same without the state: radiance is
// positive, so signs of halves are free. That of the third is set for a texel with light, that of the first for one without a surface,
// that of the second for one that is as exact as a picture at rest wants it.
// Bricks are small, as surfaces are thin: of a folded surface bricks of 8^3 keep four texels for each that some pixel can need, those
// of 4^3 two and a half, those of 2^3 one and a half, whose index would be as large as what they save.
// In a brick every texel has a place, where it says what is shown of it: pixels read nothing else. What it keeps of light is larger: only
// texels that some pixel needed have a row of that. Rows say whose they are, as pixels have no use for them. Of bricks that are kept
// whole a texel's place is its row.
#ifdef __cplusplus
constexpr uint TEXEL_BRICK_SHIFT = 2;
constexpr uint TEXEL_BRICK_EDGE = 1u << TEXEL_BRICK_SHIFT;
constexpr uint TEXELS_PER_BRICK = TEXEL_BRICK_EDGE * TEXEL_BRICK_EDGE * TEXEL_BRICK_EDGE;
constexpr uint TEXEL_STAGE_SHIFT = 16;
constexpr uint TEXEL_STAGE_MASK = 0xffu;
constexpr uint TEXEL_EMPTY = 1u << 24u;
constexpr uint TEXEL_SHOWN_LIT = 0x8000u;
constexpr uint TEXEL_SHOWN_EMPTY = 0x8000u;
constexpr uint TEXEL_SHOWN_DONE = 0x80000000u;
constexpr uint TEXEL_NOWHERE = 0xffffffffu;
constexpr uint LATTICE_REPLICATES = 4;
constexpr uint LATTICE_COVERAGE_ONE = 256;
#else
#define TEXEL_BRICK_SHIFT 2
#define TEXEL_BRICK_EDGE 4u
#define TEXELS_PER_BRICK 64u
#define TEXEL_STAGE_SHIFT 16u
#define TEXEL_STAGE_MASK 0xffu
#define TEXEL_EMPTY (1u << 24u)
#define TEXEL_SHOWN_LIT 0x8000u
#define TEXEL_SHOWN_EMPTY 0x8000u
#define TEXEL_SHOWN_DONE 0x80000000u
#define TEXEL_NOWHERE 0xffffffffu
#define LATTICE_REPLICATES 4u
#define LATTICE_COVERAGE_ONE 256.0
#endif

// A distant disc of even radiance. Directions are world axes.
struct SunParams {
    vec3 direction;
    float cosine;     // of its angular radius
    vec3 irradiance;  // on a surface that faces it
    float pad;
};
STATIC_SIZE(SunParams, 32);

// A pixel of the map that is brighter than the map's cap, by the alias method: with probability `keep` it is `pixel`, else `other`.
struct BrightPixel {
    uint pixel;
    uint other;
    float keep;
};
STATIC_SIZE(BrightPixel, 12);

struct SphereLightParams {
    vec3 position;    // grid coordinates
    float radius_mm;  // 0: a point
    vec3 intensity;
    float pad;
};
STATIC_SIZE(SphereLightParams, 32);

struct LatticeLight {
    vec3 radiance;   // of the sky: radiance + gradient * dot(direction, up), unless there is a map
    uint map_width;  // 0: no map
    vec3 gradient;
    uint map_height;
    vec3 up;
    float map_scale;
    vec3 map_x;  // images of the world's axes in those of the map
    vec3 map_y;
    vec3 map_z;
    uint sun_count;
    uint sphere_count;
    uint bright_count;
    float map_cap;       // luminance before the scale; what is above it is found by directions to bright pixels, what is below by chance
    float bright_weight; // luminance above the cap times solid angle and scale, summed over the map
    uint64_t bright;     // BrightPixel[]
    uint64_t map;        // vec3[map_width * map_height]
    uint64_t suns;       // SunParams[]
    uint64_t spheres;    // SphereLightParams[]
    uint64_t harmonics;  // vec3[25], of a lattice with transfer
};
STATIC_SIZE(LatticeLight, 144);

// Texel (i, j, k) lies at (i, j, k) * voxels_per_texel in grid coordinates, or at the volume's last samples if that is beyond them.
struct LatticeParams {
    VolumeParams volume;
    vec3 mm_x;  // world vector, mm, of one grid unit along i, j, k
    vec3 mm_y;
    vec3 mm_z;
    float value_step;  // a hundred-thousandth of the range of values: a level set is looked for that much above its texel's value
    ivec3 size;        // texels
    ivec3 brick_size;  // bricks
    float voxels_per_texel;
    uint bounces;
    uint stride;   // numbers in a texel's payload
    uint orders;   // of a lattice with transfer: 4 bits for each number of bounces
    float isovalue;     // of the shown surface
    uint projected;     // texels are lit on the shown surface, not on their own level sets
    vec3 albedo;
    float irradiance_floor;  // relative errors are of no less than this irradiance
    uint64_t index;     // uint[bricks]: slot plus one, or 0
    uint64_t wanted;    // uint[bricks * 2]: bit i of each two is set if this request needs texel i
    uint64_t coverage;  // uint[slots * TEXELS_PER_BRICK]: LATTICE_COVERAGE_ONE times the pixels that need it
    uint64_t places;    // uint[rows]: slot * TEXELS_PER_BRICK + place in the brick, or TEXEL_NOWHERE; null: rows are places
    uint64_t state;     // uint[rows]
    uint64_t payload;   // float or half [rows * stride], or four bytes each
    uint64_t shown;     // uvec2[slots * TEXELS_PER_BRICK]: radiance of a white surface as three halves, and the normal in 16 bits; see TEXEL_SHOWN_LIT
    LatticeLight light;
    uint interpolation; // as model::TexelInterpolation
    uint random_paths;  // 1: of independent random points
    float rgb8_scale;   // radiance of a white surface that the largest 8-bit number stands for
    float relative_error;  // when a texel is done: that error after samples_least, or samples_max
    uint samples_least;
    uint samples_max;
};
STATIC_SIZE(LatticeParams, 432);

// A texel that pixels need.
struct TexelItem {
    uint row;
    uint texel;    // its number in the whole lattice, i fastest
    uint coverage;
    uint state;
};
STATIC_SIZE(TexelItem, 16);

SHADER_NAMESPACE_END
#endif
