// Triangles of an isosurface, by marching cubes.
#ifndef RADIATA_SHARED_SURFACE_MESH
#define RADIATA_SHARED_SURFACE_MESH
#include "shaders/shared/interop.glsl"
SHADER_NAMESPACE_BEGIN

struct SurfaceCorner {
    vec3 position;  // grid coordinates
    vec3 normal;    // per grid unit
};
STATIC_SIZE(SurfaceCorner, 24);

struct SurfaceMeshParams {
    uint64_t corners;  // SurfaceCorner[]
    ivec3 base;        // the frame's reference point in the grid, as in IsosurfaceParams
    vec3 fraction;
    vec3 mm_x;         // world vector, mm, of one grid unit along i, j, k
    vec3 mm_y;
    vec3 mm_z;
    vec3 grid_x;       // grid vector of 1 mm along world x, y, z
    vec3 grid_y;
    vec3 grid_z;
};
STATIC_SIZE(SurfaceMeshParams, 104);

SHADER_NAMESPACE_END
#endif
