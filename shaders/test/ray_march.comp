// Runs the marches of equal steps over an array of rays against one glyph. Shared values: the coefficients, the largest radius, and for
// kFromTable a pole (3 values), for which the coefficients are rotated once instead of for each ray.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/test/function.glsl"
#include "shaders/test/ray_io.glsl"
#include "sh_basis.glsl"
#include "circle.glsl"
#include "shaders/shared/frame.glsl"
#include "shaders/common/ray_plane.glsl"
#include "shaders/common/pole_frame.glsl"
#include "van_almsick.glsl"

layout(constant_id = 1) const bool kMarchVanAlmsick = false;
layout(constant_id = 2) const uint kMarchSteps = 100u;
layout(constant_id = 3) const uint kMarchRefinements = 10u;
layout(constant_id = 4) const bool kFromTable = false;

FUNCTION_OVER(RayInput, RayOutput)

float coefficients[SH_COUNT];
float shEvaluate(vec3 direction) { return shEvaluate(coefficients, direction).x; }

#include "shaders/common/march_peeters.glsl"
#include "shaders/common/march_van_almsick.glsl"

RayOutput function(RayInput x) {
    for (int i = 0; i < SH_COUNT; ++i) coefficients[i] = push.shared_values.value[i];
    const float radius = push.shared_values.value[SH_COUNT];
    const RayPlane plane = rayPlane(x.origin, x.direction);
    GlyphHit hit = GlyphHit(0.0, 0.0, 0u);
    if (plane.h < radius) {
        const float half_chord = sqrt((radius - plane.h) * (radius + plane.h));
        const vec2 span = vec2(max(x.t_min, plane.closest - half_chord), plane.closest + half_chord);
        if (kMarchVanAlmsick) {
            const vec3 pole = kFromTable ? vec3(push.shared_values.value[SH_COUNT + 1], push.shared_values.value[SH_COUNT + 2],
                                                push.shared_values.value[SH_COUNT + 3])
                                         : -x.direction;
            float table[VAN_ALMSICK_COUNT], g[SH_K + 1];
            vanAlmsickTable(coefficients, pole, table);
            const PoleCircle circle = poleCircle(pole, x.direction, plane.e);
            const float ca = circle.azimuth.x, sa = circle.azimuth.y;
#define TABLE_ENTRY(i) table[i]
            VAN_ALMSICK_PLANE(TABLE_ENTRY, ca, sa, g)
            const vec2 cylinder = vec2(table[VAN_ALMSICK_RADIUS], table[VAN_ALMSICK_HALF_LENGTH]);
            if (kFromTable) hit = vanAlmsickFirstHit(vanAlmsickRay(g, cylinder, circle.offset, plane), span, x.both_lobes != 0u);
            else hit = vanAlmsickFirstHit(vanAlmsickParallel(g, cylinder, plane), span, x.both_lobes != 0u);
        } else {
            hit = peetersFirstHit(x.origin, x.direction, span, x.both_lobes != 0u);
        }
    }
    return RayOutput(hit.t, hit.amplitude, hit.steps, 0u, vec3(0.0));
}

FUNCTION_MAIN
