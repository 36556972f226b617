// The coverage buffer of the latest picture as the new camera sees it: a mesh with a vertex at each texel's centre, rasterised here; of
// triangles over each other the farther counts. One invocation per mesh of the grid, two triangles.
// Source: Schertzer et al. 2022, Sec. 3.4.2. Note: the paper does not say which of two layers of the mesh stays, and what texels show
// that it leaves free; here nothing is culled there.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/common/pixel_place.glsl"
#include "shaders/common/invocation.glsl"
#include "shaders/fiblet/coverage.glsl"

FibletCoverageParams coverage;

// Column and row in texels, depth, nearness; nearness 0: before the eye.
vec4 movedVertex(ivec2 texel) {
    const float depth = depthOfOrder(UintBuffer(coverage.dilated).at[texel.y * coverage.columns + texel.x]);
    const FibletView before = coverage.before, now = coverage.now;
    const vec3 from_origin = before.reference_high + (before.reference_low + fibletPointAt(before, texelCentre(before, texel), depth));
    const vec4 eye = fibletEyePoint(now, from_origin);
    if (!(eye.w > 1e-5)) return vec4(0.0);
    return vec4((fibletPixel(now, eye) - vec2(now.window_x, now.window_y)) / float(FIBLET_TEXEL) - 0.5, eye.z, eye.w);
}

float edge(vec2 a, vec2 b, vec2 p) { return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x); }

void drawTriangle(vec4 a, vec4 b, vec4 c) {
    const float area = edge(a.xy, b.xy, c.xy);
    if (min(a.w, min(b.w, c.w)) <= 0.0 || !(abs(area) > 1e-12)) return;
    const vec2 limit = vec2(coverage.columns, coverage.rows);
    const ivec2 first = ivec2(ceil(clamp(min(a.xy, min(b.xy, c.xy)), vec2(0.0), limit)));
    const ivec2 last = min(ivec2(floor(clamp(max(a.xy, max(b.xy, c.xy)), vec2(-1.0), limit))), ivec2(limit) - 1);
    for (int y = first.y; y <= last.y; ++y) {
        for (int x = first.x; x <= last.x; ++x) {
            const vec2 p = vec2(x, y);
            const vec3 share = vec3(edge(b.xy, c.xy, p), edge(c.xy, a.xy, p), edge(a.xy, b.xy, p)) / area;
            if (min(share.x, min(share.y, share.z)) < 0.0) continue;
            const vec3 weights = share / vec3(a.w, b.w, c.w);
            const float depth = dot(weights, vec3(a.z, b.z, c.z)) / (weights.x + weights.y + weights.z);
            atomicMax(UintBuffer(coverage.moved).at[y * coverage.columns + x], orderOfDepth(depth));
        }
    }
}

void main() {
    coverage = push.coverage.params;
    const int columns = coverage.columns - 1, at = int(globalInvocation());
    if (columns < 1 || at >= columns * (coverage.rows - 1)) return;
    const ivec2 texel = pixelPlace(uint(at), uint(columns));
    const vec4 a = movedVertex(texel), b = movedVertex(texel + ivec2(1, 0));
    const vec4 c = movedVertex(texel + ivec2(0, 1)), d = movedVertex(texel + ivec2(1, 1));
    drawTriangle(a, b, d);
    drawTriangle(a, d, c);
}
