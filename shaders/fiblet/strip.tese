// A point of a fiblet that strip.tesc decoded.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/fiblet/layer_buffers.glsl"
#include "shaders/fiblet/line_end.glsl"
#include "shaders/fiblet/patch.glsl"

layout(isolines, equal_spacing) in;

layout(push_constant, scalar) uniform Push { LayerBuffer layer; } push;

layout(location = 0) in vec4 points[][kPartPoints];
layout(location = 16) patch in uvec2 fiblet_and_lines;
layout(location = 0) flat out vec4 from;  // of the segment that begins here
layout(location = 1) flat out vec4 to;
layout(location = 2) flat out uvec2 who;  // and number of segments

vec4 pointOf(uint point) { return points[point / kPartPoints][point % kPartPoints]; }

void main() {
    const FibletView view = push.layer.layer.view;
    const uint lines = fiblet_and_lines.y, point = uint(gl_TessCoord.x * float(lines) + 0.5);
    const vec4 here = pointOf(point), next = pointOf(min(point + 1u, lines));
    from = fibletEyePoint(view, here.xyz);
    to = fibletEyePoint(view, next.xyz);
    who = uvec2(fiblet_and_lines.x << FIBLET_SEGMENT_BITS | uint(here.w), uint(next.w - here.w));
    gl_Position = fibletClip(view, from);
}
