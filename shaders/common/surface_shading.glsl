// How isosurfaces with a look of their own are coloured and lit. Included by passes that have declared kSurfaceLooks, the bits of
// what some layer has. Source: Wyman et al. 2006, Sec. 5 and Fig. 9.
#ifndef RADIATA_COMMON_SURFACE_SHADING
#define RADIATA_COMMON_SURFACE_SHADING
#include "shaders/shared/frame.glsl"
#include "shaders/shared/layer_look.glsl"
#include "shaders/shared/surface_look.glsl"
#include "shaders/common/camera_rays.glsl"
#include "shaders/common/colour_map.glsl"
#include "shaders/common/phong.glsl"
#include "shaders/common/volume.glsl"

layout(buffer_reference, scalar) readonly buffer SurfaceLookBuffer { SurfaceLook at[]; };

bool looksBy(uint bit) { return (kSurfaceLooks & bit) != 0u; }

bool shadesItself(SurfaceLook own) { return looksBy(SURFACE_LOOKS_SHADING) && own.shading != SURFACE_SCENE; }

// Linear RGB, of a point relative to the frame's reference point; grey where the colouring volume has no number.
vec3 surfaceColour(SurfaceLook own, LayerLook look, vec3 point) {
    if (!looksBy(SURFACE_LOOKS_VOLUME) || own.values.samples == 0ul) return look.uniform_colour;
    const vec3 offset = own.fraction + gridVector(own.values, point);
    const ivec3 cell = clamp(own.base + ivec3(floor(offset)), ivec3(0), own.values.size - 2);
    const vec3 at = offset - vec3(cell - own.base);
    float c[8];
    const bool inside = all(greaterThanEqual(at, vec3(-1e-6))) && all(lessThanEqual(at, vec3(1.0 + 1e-6)));
    if (!inside || !cellCorners(own.values, cell, 0.0, c)) return vec3(0.214);  // sRGB grey 0.5
    return mappedColour(ColourTable(look.map), cellValue(c, clamp(at, 0.0, 1.0)), look.range_low, look.range_high);
}

// Radiance towards the viewer of a surface that shades itself. \param lit  share of the light that reaches it; \param open  the same
// of ambient light
vec3 shadeItself(FrameParams frame, SurfaceLook own, vec3 base, vec3 normal, vec3 viewer, float lit, float open) {
    const vec3 reflected = own.shading == SURFACE_PHONG ? phongReflection(base, normal, viewer, frame.light_direction)
                                                        : lambertReflection(base, normal, frame.light_direction);
    return lit * frame.irradiance * reflected + open * frame.ambient * varyingAmbient(normal, frame.light_direction) * base;
}

// Share of the background before a hit. OpenGL's linear fog, over the volume's box.
float surfaceFog(FrameParams frame, SurfaceLook own, PixelRay ray, float depth) {
    if (!looksBy(SURFACE_LOOKS_FOG)) return 0.0;
    const float forward = depth * dot(ray.direction, frame.rays.forward);
    return own.fog * clamp((forward - own.fog_begin) * own.fog_per_mm, 0.0, 1.0);
}

#endif
