// The depths of a picture, dilated: each texel is a ball as large as a fiblet is long, and the coverage buffer keeps the farthest depth
// that a ball reaches. One invocation per texel; it writes all texels under its ball.
// Source: Schertzer et al. 2022, Sec. 3.4.2, Eq. 4 with the texel's half diagonal in place of its half edge.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/common/pixel_place.glsl"
#include "shaders/common/invocation.glsl"
#include "shaders/fiblet/coverage.glsl"

void main() {
    const FibletCoverageParams coverage = push.coverage.params;
    const FibletView view = coverage.before;
    const int at = int(globalInvocation());
    if (at >= coverage.columns * coverage.rows) return;
    const ivec2 texel = pixelPlace(uint(at), uint(coverage.columns));
    const float farthest = depthOfOrder(UintBuffer(coverage.depths).at[at]);
    const float depth = farthest < 3e38 ? farthest : coverage.far_depth;  // words of pixels without a fibre are no numbers
    const float nearness = 1.0 + depth * view.inverse_distance;
    if (!(nearness > 0.0)) return;
    const float pixel_mm = nearness * inversesqrt(dot(view.right, view.right));
    const float radius = coverage.reach + 0.5 * sqrt(2.0) * float(FIBLET_TEXEL) * pixel_mm;
    const vec3 centre = fibletPointAt(view, texelCentre(view, texel), depth);
    // A ball that is off the axis is an ellipse in the picture; one texel more holds it.
    const int reach = int(min(radius / pixel_mm / float(FIBLET_TEXEL) + 2.0, float(max(coverage.columns, coverage.rows))));
    const ivec2 first = max(texel - reach, ivec2(0)), last = min(texel + reach, ivec2(coverage.columns, coverage.rows) - 1);
    for (int y = first.y; y <= last.y; ++y) {
        for (int x = first.x; x <= last.x; ++x) {
            const float carved = fibletCarvedDepth(view, texelCentre(view, ivec2(x, y)), centre, radius);
            if (carved > depth || (x == texel.x && y == texel.y)) {
                atomicMax(UintBuffer(coverage.dilated).at[y * coverage.columns + x], orderOfDepth(carved));
            }
        }
    }
}
