// Points and boxes in pixels and depth, for drawing and culling fiblets. See FibletView in shaders/shared/fiblet_draw.glsl.
// Twin: server/reference/fibre_picture.
#ifndef RADIATA_COMMON_FIBLET_PROJECTION
#define RADIATA_COMMON_FIBLET_PROJECTION
#include "shaders/shared/fiblet_draw.glsl"

// Before the division: dot products with right and up, d, and nearness. \param p  mm from the fiblets' origin
vec4 fibletEyePoint(FibletView view, vec3 p) {
    const vec3 q = (p - view.reference_high) - view.reference_low;
    const float d = dot(view.forward, q);
    return vec4(dot(view.right, q), dot(view.up, q), d, 1.0 + d * view.inverse_distance);
}

// Column and row in the whole picture. \param eye  of positive nearness
vec2 fibletPixel(FibletView view, vec4 eye) {
    const float farther = 1.0 / eye.w;
    return vec2(view.centre.x + eye.x * farther, view.centre.y - eye.y * farther);
}

// Least and greatest of dot(axis, q) over a box about `middle`.
vec2 fibletSpan(vec3 axis, vec3 middle, vec3 reach) {
    const float m = dot(axis, middle), r = dot(abs(axis), reach);
    return vec2(m - r, m + r);
}

// Pixels that lines inside of a box can touch, and the least depth there.
struct FibletFootprint {
    bool seen;      // false: outside of the window or of the depths
    ivec4 pixels;   // of the window: first column, first row, last column, last row
    float nearest;  // depth
};

// \param margin  pixels beside the line that are drawn with it; \param grown  mm beside it
FibletFootprint fibletFootprint(FibletView view, vec3 low, vec3 high, float margin, float grown) {
    const vec3 middle = (0.5 * (low + high) - view.reference_high) - view.reference_low;
    const vec3 reach = 0.5 * (high - low) + view.rounding + grown;
    const vec2 depth = fibletSpan(view.forward, middle, reach);
    FibletFootprint footprint;
    footprint.nearest = depth.x;
    footprint.pixels = ivec4(0, 0, view.width - 1, view.height - 1);
    footprint.seen = depth.y >= view.near_depth && depth.x <= view.far_depth;
    // A box that reaches before the near plane may be anywhere in the picture.
    const float least = 1.0 + depth.x * view.inverse_distance, most = 1.0 + depth.y * view.inverse_distance;
    if (!footprint.seen || depth.x < view.near_depth || least < 1e-5) return footprint;
    const vec2 x = fibletSpan(view.right, middle, reach), y = fibletSpan(view.up, middle, reach);
    const vec2 column = vec2(min(x.x / least, x.x / most), max(x.y / least, x.y / most)) + view.centre.x;
    const vec2 row = view.centre.y - vec2(max(y.y / least, y.y / most), min(y.x / least, y.x / most));
    // 1/50 pixel and one in a million cover what drawing rounds.
    const float slack = margin + 0.52 + 1e-6 * (abs(column.x) + abs(column.y) + abs(row.x) + abs(row.y));
    const vec2 first = vec2(column.x, row.x) - slack - vec2(view.window_x, view.window_y);
    const vec2 last = vec2(column.y, row.y) + slack - vec2(view.window_x, view.window_y);
    footprint.seen = last.x >= 0.0 && last.y >= 0.0 && first.x <= float(view.width) && first.y <= float(view.height);
    if (footprint.seen) {
        footprint.pixels = ivec4(ivec2(max(floor(first), 0.0)),
                                 ivec2(min(floor(last), vec2(view.width - 1, view.height - 1))));
        footprint.pixels.xy = min(footprint.pixels.xy, footprint.pixels.zw);
    }
    return footprint;
}

#endif
