// One point of a deformed sphere. The rasteriser's depth orders the triangles of a layer; the ray parameter that the surface
// buffer keeps comes from the point itself, relative to its glyph, so it does not suffer from the range of depth.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/frame.glsl"
#include "shaders/shared/raster.glsl"
#include "shaders/common/camera_rays.glsl"
#include "shaders/common/octahedral.glsl"

layout(constant_id = 1) const bool kFirstLayer = true;        // nothing is in the surface buffer yet
layout(constant_id = 2) const bool kTriangleNormals = false;  // of the flat triangles instead of the glyph

layout(buffer_reference, scalar) readonly buffer FrameBuffer { FrameParams frame; };
layout(buffer_reference, scalar) readonly buffer SurfaceBuffer { Surface at[]; };

layout(push_constant, scalar) uniform Push {
    FrameBuffer frame;
    uint64_t layer;  // this and the next are mesh.vert's
    uint64_t view;
    uint64_t list;
    uint64_t vertices;
    uint first;
    uint vertex_count;
    SurfaceBuffer surface;
} push;

layout(location = 0) flat in uint glyph;
layout(location = 1) flat in vec3 centre;
layout(location = 2) in vec3 offset;
layout(location = 3) in vec3 normal;
layout(location = 0) out uvec4 words;  // glyph, ray parameter, normal as an octahedral pair

void main() {
    const FrameParams frame = push.frame.frame;
    const uvec2 pixel = uvec2(gl_FragCoord.xy);
    const PixelRay ray = pixelRay(frame.rays, vec2(frame.width, frame.height), vec2(pixel) + 0.5 + frame.jitter);
    const float t = dot(centre - ray.origin + offset, ray.direction);
    vec3 outwards = normal;
    if (kTriangleNormals) outwards = cross(dFdx(offset), dFdy(offset));
    const float size = length(outwards);
    outwards = size > 0.0 ? outwards / size : -ray.direction;
    if (dot(outwards, ray.direction) > 0.0) outwards = -outwards;
    if (!kFirstLayer && t >= push.surface.at[pixel.y * frame.width + pixel.x].depth) discard;
    words = uvec4(glyph, floatBitsToUint(t), floatBitsToUint(octahedralOf(outwards)));
}
