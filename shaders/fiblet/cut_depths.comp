// Depths of a cutting mesh in each pixel: of its nearest front face and of its farthest back face. One workgroup per triangle, whose
// pixels are cast one by one. Source: Schertzer et al. 2022, Sec. 5.1 (two passes of the rasteriser); ray and triangle: Moeller and
// Trumbore 1997.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/common/invocation.glsl"
#include "shaders/common/pixel_place.glsl"
#include "shaders/fiblet/layer.glsl"

layout(buffer_reference, scalar) readonly buffer CornerBuffer { vec3 at[]; };
layout(push_constant, scalar) uniform Push {
    LayerBuffer layer;
    CornerBuffer corners;
    uint first;  // triangle of this dispatch
} push;

void main() {
    const FibletLayerParams layer = push.layer.layer;
    FibletView view = layer.view;
    const uint t = 3u * (push.first + gl_WorkGroupID.x);
    const vec3 p[3] = vec3[3](push.corners.at[t], push.corners.at[t + 1u], push.corners.at[t + 2u]);
    // The mesh counts where the fibres are not, too.
    view.near_depth = -3e38;
    view.far_depth = 3e38;
    const FibletFootprint footprint = fibletFootprint(view, min(min(p[0], p[1]), p[2]), max(max(p[0], p[1]), p[2]), 0.0, 0.0);
    if (!footprint.seen) return;
    const vec3 a = (p[0] - view.reference_high) - view.reference_low;
    const vec3 ab = p[1] - p[0], ac = p[2] - p[0], normal = cross(ab, ac);
    const vec3 right = view.right / dot(view.right, view.right), up = view.up / dot(view.up, view.up);
    const int columns = footprint.pixels.z - footprint.pixels.x + 1, rows = footprint.pixels.w - footprint.pixels.y + 1;
    for (uint i = localInvocation(); i < uint(columns * rows); i += gl_WorkGroupSize.x) {
        const ivec2 inside = pixelPlace(i, uint(columns));
        const int x = footprint.pixels.x + inside.x, y = footprint.pixels.y + inside.y;
        const vec2 place = vec2(float(x + view.window_x) + 0.5 - view.centre.x, view.centre.y - float(y + view.window_y) - 0.5);
        const vec3 origin = place.x * right + place.y * up;
        const vec3 direction = origin * view.inverse_distance + view.forward;  // its parameter is the depth
        const float facing = dot(normal, direction);
        if (facing == 0.0) continue;
        const vec3 away = cross(origin - a, direction);
        const float u = -dot(away, ac) / facing, v = dot(away, ab) / facing;
        if (!(u >= 0.0 && v >= 0.0 && u + v <= 1.0)) continue;
        const float depth = dot(normal, a - origin) / facing;
        if (!(1.0 + depth * view.inverse_distance > 1e-5)) continue;
        const uint pixel = uint(y * view.width + x), order = orderOfDepth(depth);
        if (facing < 0.0) atomicMin(UintBuffer(layer.cut_front).at[pixel], order);
        else atomicMax(UintBuffer(layer.cut_back).at[pixel], order);
    }
}
