// How far in pixels a straight line can be from the fibre between its ends.
// All points of a piece of length L between ends a chord c apart lie in the ellipsoid with these ends as foci and L as its longest
// diameter, whose other half axes are sqrt(L^2 - c^2) / 2; and no point of the line is farther from the fibre either.
#ifndef RADIATA_COMMON_FIBLET_DETAIL
#define RADIATA_COMMON_FIBLET_DETAIL
#include "shaders/shared/fiblet_draw.glsl"

// Pixels; infinite where the piece may reach before the near plane.
// \param a, b    eye points of the ends \param length_mm  of the piece; \param chord_mm  between its ends
// \param slack   mm that the piece's last point may be from b
float fibletChordError(FibletView view, vec4 a, vec4 b, float length_mm, float chord_mm, float slack) {
    const float least = max(chord_mm - slack, 0.0);
    // Float32 leaves some nanometres of a difference of squares open.
    const float off = 0.5 * sqrt(max(length_mm * length_mm - least * least, 0.0)) + slack + view.rounding;
    const float depth = min(a.z, b.z) - length_mm;
    const float nearness = 1.0 + depth * view.inverse_distance;
    if (!(depth > view.near_depth) || !(nearness > 0.0)) return uintBitsToFloat(0x7f800000u);
    // Off the axis a distance in depth moves the pixel too: by as much as the ray is longer than its depth.
    const float scale = length(view.right) / nearness;
    const float slope = view.inverse_distance * (max(length(a.xy), length(b.xy)) / nearness / length(view.right));
    return off * scale * sqrt(1.0 + slope * slope);
}

// Whether the ball about a fiblet's first point that holds it is under four pixels wide (Schertzer et al. 2022, Sec. 3.4.4).
bool fibletIsSmall(FibletView view, vec4 eye, float reach_mm) {
    const float nearness = 1.0 + (eye.z - reach_mm) * view.inverse_distance;
    return 2.0 * reach_mm * length(view.right) < 4.0 * nearness;
}

#endif
