// A point of a fiblet that strip.tesc decoded.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/fiblet/layer_buffers.glsl"
#include "shaders/fiblet/line_end.glsl"
#include "shaders/fiblet/patch.glsl"

layout(isolines, equal_spacing) in;

layout(push_constant, scalar) uniform Push { LayerBuffer layer; } push;

layout(location = 0) in vec3 points[][kPartPoints];
layout(location = 16) patch in uvec2 fiblet_and_segments;
layout(location = 0) flat out vec4 from;  // of the segment that begins here
layout(location = 1) flat out vec4 to;
layout(location = 2) flat out uint who;

vec4 eyeOf(FibletView view, uint point) { return fibletEyePoint(view, points[point / kPartPoints][point % kPartPoints]); }

void main() {
    const FibletView view = push.layer.layer.view;
    const uint segments = fiblet_and_segments.y, point = uint(gl_TessCoord.x * float(segments) + 0.5);
    from = eyeOf(view, point);
    to = eyeOf(view, min(point + 1u, segments));
    who = fiblet_and_segments.x << FIBLET_SEGMENT_BITS | point;
    gl_Position = fibletClip(view, from);
}
