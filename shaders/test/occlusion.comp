// Runs glyph_occlusion.glsl over an array of rays against one glyph, by the pole frame of each ray's origin or (kSun) of its direction.
// Shared values: the glyph's coefficients and its largest radius.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/test/function.glsl"
#include "shaders/test/visibility_io.glsl"
#include "sh_basis.glsl"
#include "circle.glsl"
#include "pole_table.glsl"
#include "shaders/shared/frame.glsl"
#include "shaders/common/glyph_occlusion.glsl"

layout(constant_id = 1) const uint kSource = 0u;  // of the circle: 0 coefficients, 1 table of the origin, 2 table of the direction

FUNCTION_OVER(OcclusionInput, OcclusionOutput)

OcclusionOutput function(OcclusionInput x) {
    float c[SH_COUNT];
    for (int i = 0; i < SH_COUNT; ++i) c[i] = push.shared_values.value[i];
    const RayPlane plane = rayPlane(x.origin, x.direction);
    vec2 F[CIRCLE_HARMONICS + 1];
    if (kSource == 0u) {
        circleFourier(c, x.direction, plane.e, F);
    } else {
        const vec3 axis = kSource == 1u ? originAxis(x.origin) : -x.direction;
        float table[POLE_TABLE_COUNT];
        poleTableBuild(c, axis, table);
        const PoleCircle circle = poleCircle(axis, x.direction, plane.e);
        const float ca = circle.azimuth.x, sa = circle.azimuth.y;
#define TABLE_ENTRY(i) table[i]
        POLE_TABLE_FOURIER(TABLE_ENTRY, ca, sa, F)
        poleCircleShift(F, circle.offset);
    }
    const float radius = push.shared_values.value[SH_COUNT];
    const CircleOcclusion hit = glyphOcclusion(F, plane, radius, x.t_max, x.on_surface != 0u, x.both_lobes != 0u);
    return OcclusionOutput(hit.blocked ? 1u : 0u, hit.capped ? 1u : 0u);
}

FUNCTION_MAIN
