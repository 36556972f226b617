// A scalar volume on the device, and a layer that shows one of its isosurfaces.
#ifndef RADIATA_SHARED_ISOSURFACE
#define RADIATA_SHARED_ISOSURFACE
#include "shaders/shared/interop.glsl"
SHADER_NAMESPACE_BEGIN

// Samples from this value on stand for voxels without a number (NaN, infinite): cells that touch one are outside the volume.
// Bricks are cubes of cells with the range of all samples that their cells touch; blocks are the coarser level.
#ifdef __cplusplus
constexpr float VOLUME_NO_VALUE = 3.0e38F;
constexpr uint BRICK_SHIFT = 2;
constexpr uint BLOCK_SHIFT = 4;
#else
#define VOLUME_NO_VALUE 3.0e38
#define BRICK_SHIFT 2
#define BLOCK_SHIFT 4
#endif

// Grid coordinates: sample (i, j, k) lies at (i, j, k), so cells are unit cubes and the volume is [0, size - 1]^3.
struct VolumeParams {
    uint64_t samples;   // float[size.x * size.y * size.z], i fastest
    uint64_t bricks;    // vec2[brick_size.x * ...]: least and largest sample, i fastest
    uint64_t blocks;    // the same for blocks
    ivec3 size;         // samples, each at least 2
    ivec3 brick_size;   // bricks
    ivec3 block_size;   // blocks
    vec3 grid_x;        // grid vector of 1 mm along world x, y, z
    vec3 grid_y;
    vec3 grid_z;
    float voxel_mm;     // shortest voxel edge
    uint pad;
};
STATIC_SIZE(VolumeParams, 104);

// A layer in a frame. The frame's reference point is at base + fraction in the grid: rays are walked relative to base, so a
// close-up keeps its precision wherever in the volume it is.
struct IsosurfaceParams {
    VolumeParams volume;
    ivec3 base;
    vec3 fraction;
    float isovalue;
    uint layer;
    float step;        // march-bisect: step, shortest voxel edges
    uint pad;
};
STATIC_SIZE(IsosurfaceParams, 144);

SHADER_NAMESPACE_END
#endif
