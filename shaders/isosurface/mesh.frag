// One point of an isosurface's triangles. The words are those of glyph/mesh.frag, for the pass that fills the surface buffer.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/frame.glsl"
#include "shaders/shared/surface_mesh.glsl"
#include "shaders/common/camera_rays.glsl"
#include "shaders/common/octahedral.glsl"

layout(constant_id = 1) const bool kFirstLayer = true;  // nothing is in the surface buffer yet

layout(buffer_reference, scalar) readonly buffer FrameBuffer { FrameParams frame; };
layout(buffer_reference, scalar) readonly buffer SurfaceBuffer { Surface at[]; };

layout(push_constant, scalar) uniform Push {
    FrameBuffer frame;
    uint64_t mesh;  // this and the next are mesh.vert's
    uint64_t view;
    SurfaceBuffer surface;
} push;

layout(location = 0) in vec3 place;
layout(location = 1) in vec3 normal;
layout(location = 0) out uvec4 words;  // who, ray parameter, normal as an octahedral pair

void main() {
    const FrameParams frame = push.frame.frame;
    const uvec2 pixel = uvec2(gl_FragCoord.xy);
    const PixelRay ray = pixelRay(frame.rays, vec2(frame.width, frame.height), vec2(pixel) + 0.5 + frame.jitter);
    const float t = dot(place - ray.origin, ray.direction);
    const float size = length(normal);
    vec3 outwards = size > 0.0 ? normal / size : -ray.direction;
    if (dot(outwards, ray.direction) > 0.0) outwards = -outwards;
    if (!kFirstLayer && t >= push.surface.at[pixel.y * frame.width + pixel.x].depth) discard;
    words = uvec4(0u, floatBitsToUint(t), floatBitsToUint(octahedralOf(outwards)));
}
