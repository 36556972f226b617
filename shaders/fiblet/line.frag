// One pixel of a line that the device's rasteriser has drawn, by whichever pipeline: depth at the pixel's centre along the line's longer
// axis, as raster.comp has it, and who it is.
#version 460
#extension GL_GOOGLE_include_directive : require
#ifdef MESH
#extension GL_EXT_mesh_shader : require
#define PER_SEGMENT perprimitiveEXT flat
#else
#define PER_SEGMENT flat
#endif
#include "shaders/fiblet/layer_buffers.glsl"
#include "shaders/common/depth_code.glsl"
#include "shaders/common/fibre_directions.glsl"

layout(constant_id = 2) const uint kCuts = 0u;
layout(constant_id = 9) const bool kSegments = false;  // some segments are left out
layout(constant_id = 10) const bool kDetail = false;   // lines may stand for many segments, of which none is left out then
layout(constant_id = 11) const bool kSmallAsLines = false;

layout(push_constant, scalar) uniform Push { LayerBuffer layer; } push;

layout(location = 0) PER_SEGMENT in vec4 from;  // eye points of the ends
layout(location = 1) PER_SEGMENT in vec4 to;
layout(location = 2) PER_SEGMENT in uvec2 who;  // the first segment that it stands for, and how many
layout(location = 0) out uvec4 words;  // who, depth, tangent, 0

void main() {
    const FibletView view = push.layer.layer.view;
    if (who.x == FIBLET_NOBODY) discard;
    if (kSegments && (WordBuffer(push.layer.layer.segments).at[who.x >> FIBLET_SEGMENT_BITS] >> (who.x & FIBLET_SEGMENTS) & 1ul) == 0ul) discard;
    const vec3 way = to.xyz - from.xyz;
    vec4 a = from, b = to;
    vec2 shares = vec2(0.0, 1.0);  // of the whole line at a and b
    if (min(a.z, b.z) < view.near_depth) {
        if (!(max(a.z, b.z) >= view.near_depth)) discard;
        const float at = (view.near_depth - a.z) / (b.z - a.z);
        const vec4 crossing = mix(a, b, at);
        if (a.z < view.near_depth) {
            a = crossing;
            shares.x = at;
        } else {
            b = crossing;
            shares.y = at;
        }
    }
    const vec2 pixel_a = fibletPixel(view, a), pixel_b = fibletPixel(view, b);
    const vec2 along = pixel_b - pixel_a, at = floor(gl_FragCoord.xy) + vec2(view.window_x, view.window_y) + 0.5;
    const bool columns = abs(along.x) >= abs(along.y);
    const float length_px = columns ? along.x : along.y;
    const float passed = columns ? at.x - pixel_a.x : at.y - pixel_a.y;
    const float share = length_px == 0.0 ? 0.0 : clamp(passed / length_px, 0.0, 1.0);
    // Pixels that the segment does not come near are not of it; see line_end.glsl.
    const vec2 off = abs(at - mix(pixel_a, pixel_b, share));
    if (max(off.x, off.y) > 0.5 * view.line_width + 1.5) discard;
    const float s = share * a.w / (share * a.w + (1.0 - share) * b.w);
    const vec3 eye = mix(a.xyz, b.xyz, s);
    if (eye.z > view.far_depth) discard;
    const vec3 right = view.right / dot(view.right, view.right), up = view.up / dot(view.up, view.up);
    if (kCuts > 0u) {
        const vec3 p = (eye.x * right + eye.y * up + eye.z * view.forward) + view.reference_low + view.reference_high;
        for (uint i = 0u; i < kCuts; ++i) {
            if (dot(push.layer.layer.cuts[i].normal, p) > push.layer.layer.cuts[i].offset) discard;
        }
    }
    uint here = who.x;
    if (kDetail || kSmallAsLines) here += min(uint(mix(shares.x, shares.y, s) * float(who.y)), who.y - 1u);
    gl_FragDepth = depthOfParameter(eye.z);
    words = uvec4(here, floatBitsToUint(eye.z), packLine(way.x * right + way.y * up + way.z * view.forward), 0u);
}
