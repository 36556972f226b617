// Lengths of rays inside of one glyph, by the march over all crossings.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/test/function.glsl"
#include "shaders/test/inside_io.glsl"
#include "sh_basis.glsl"
#include "circle.glsl"

FUNCTION_OVER(InsideInput, InsideOutput)

#include "shaders/test/glyph_circle.glsl"
#include "shaders/common/circle_inside.glsl"

InsideOutput function(InsideInput x) {
    const RayPlane plane = rayPlane(x.origin, x.direction);
    vec2 F[CIRCLE_HARMONICS + 1];
    rayCircle(x.direction, plane.e, F);
    const float radius = push.shared_values.value[SH_COUNT];
    const CircleInside inside = circleInside(F, plane.h, plane.closest, radius, x.begin, x.end, x.both_lobes != 0u);
    return InsideOutput(inside.travelled, inside.steps, inside.capped ? 1u : 0u);
}

FUNCTION_MAIN
