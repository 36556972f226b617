// What shading reads of an isosurface layer beyond its LayerLook: reflection, fog, and the volume that colours it.
#ifndef RADIATA_SHARED_SURFACE_LOOK
#define RADIATA_SHARED_SURFACE_LOOK
#include "shaders/shared/isosurface.glsl"
SHADER_NAMESPACE_BEGIN

// Values of SurfaceLook.shading: the order of model::SurfaceShading.
// Bits of kSurfaceLooks, the specialisation constant that says what some layer of the scene has.
#ifdef __cplusplus
constexpr uint SURFACE_SCENE = 0;
constexpr uint SURFACE_LAMBERT = 1;
constexpr uint SURFACE_PHONG = 2;
constexpr uint SURFACE_LOOKS_SHADING = 1;
constexpr uint SURFACE_LOOKS_FOG = 2;
constexpr uint SURFACE_LOOKS_VOLUME = 4;
#else
#define SURFACE_SCENE 0u
#define SURFACE_LAMBERT 1u
#define SURFACE_PHONG 2u
#define SURFACE_LOOKS_SHADING 1u
#define SURFACE_LOOKS_FOG 2u
#define SURFACE_LOOKS_VOLUME 4u
#endif

struct SurfaceLook {
    VolumeParams values;  // of the volume that colours the surface; samples 0: none
    ivec3 base;           // the frame's reference point in its grid, as in IsosurfaceParams
    vec3 fraction;
    float fog;            // share of the background at the far end; 0: none
    float fog_begin;      // along the line of sight, mm from the reference plane
    float fog_per_mm;     // 1 over the distance from the near end to the far one
    uint shading;
};
STATIC_SIZE(SurfaceLook, 144);

SHADER_NAMESPACE_END
#endif
