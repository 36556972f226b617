// A secondary ray against one glyph, through the pole frame of the ray's own origin: all rays from one point span planes through the
// axis from the glyph's centre to that point, so one table serves them all. For parallel rays the axis is against their direction.
// Needs the layout's circle.glsl and pole_table.glsl. Twin: server/reference/visibility.
#ifndef RADIATA_COMMON_GLYPH_OCCLUSION
#define RADIATA_COMMON_GLYPH_OCCLUSION
#include "shaders/common/circle_march.glsl"
#include "shaders/common/circle_occlusion.glsl"
#include "shaders/common/pole_frame.glsl"
#include "shaders/common/ray_plane.glsl"

// Axis of the pole frame for rays from one point. \param origin  relative to the centre, any length
vec3 originAxis(vec3 origin) { return dot(origin, origin) > 0.0 ? normalize(origin) : vec3(0.0, 0.0, 1.0); }

// \param F  of the ray's circle; \param plane  of the ray; lengths in units of amplitude
// \param t_max  where the ray ends, 1e30: nowhere; \param on_surface  the ray begins on this glyph, up to rounding
CircleOcclusion glyphOcclusion(const vec2 F[CIRCLE_HARMONICS + 1], RayPlane plane, float radius, float t_max, bool on_surface,
                               bool both_lobes) {
    const vec2 start = circleStart(plane.closest, plane.h, 0.0);
    const vec2 end = t_max < 1e29 ? circleStart(plane.closest, plane.h, t_max) : vec2(-1.0, 0.0);
    const float h = on_surface ? circleSurfaceHeight(F, start) : plane.h;
    return circleOcclusion(F, h, radius, start, end, both_lobes);
}

#endif
