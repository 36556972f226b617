// The circle of a ray's plane, from samples or from a pole-frame table. Shared values: the glyph's coefficients, its largest
// radius, and for kFromTable the pole (3 values) and the table. The includer includes sh_basis.glsl and circle.glsl first.
#include "pole_table.glsl"
#include "shaders/shared/frame.glsl"
#include "shaders/common/ray_plane.glsl"
#include "shaders/common/circle_march.glsl"
#include "shaders/common/pole_frame.glsl"

layout(constant_id = 1) const bool kFromTable = false;

void rayCircle(vec3 d, vec3 e, out vec2 F[CIRCLE_HARMONICS + 1]) {
    if (kFromTable) {
        const vec3 q = vec3(push.shared_values.value[SH_COUNT + 1], push.shared_values.value[SH_COUNT + 2],
                            push.shared_values.value[SH_COUNT + 3]);
        const PoleCircle circle = poleCircle(q, d, e);
        const float ca = circle.azimuth.x, sa = circle.azimuth.y;
#define TABLE_ENTRY(i) push.shared_values.value[SH_COUNT + 4 + i]
        POLE_TABLE_FOURIER(TABLE_ENTRY, ca, sa, F)
        poleCircleShift(F, circle.offset);
    } else {
        float c[SH_COUNT];
        for (int i = 0; i < SH_COUNT; ++i) c[i] = push.shared_values.value[i];
        circleFourier(c, d, e, F);
    }
}
