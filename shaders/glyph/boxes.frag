// First hit of the pixel's ray with the glyph whose box covers it: one march per fragment. The depth test keeps the nearest of
// them; depth carries the ray parameter without loss, so the picture is the traced one.
#version 460
#extension GL_GOOGLE_include_directive : require
#define GLYPH_WITHOUT_GROUPS
#include "shaders/glyph/layer.glsl"
#include "shaders/glyph/intersect.glsl"
#include "shaders/common/glyph_normal.glsl"
#include "shaders/common/depth_code.glsl"

// Per pixel, order preserving: the nearest hit so far. Whatever moment it is read at, it is never nearer than the last one, so what
// lies behind it can be left out; on devices that draw fragments in parallel only the count of steps depends on that moment.
layout(buffer_reference, scalar) coherent buffer NearestBuffer { uint at[]; };
layout(buffer_reference, scalar) buffer StepBuffer { uint at[]; };

layout(push_constant, scalar) uniform Push {
    FrameBuffer frame;
    LayerBuffer layer;
    uint64_t view;  // of boxes.vert
    uint64_t list;
    SurfaceBuffer surface;
    CounterBuffer counters;
    NearestBuffer nearest;
    StepBuffer steps;
} push;

layout(location = 0) flat in uint glyph;
layout(location = 0) out uvec4 words;  // glyph, normal

uint orderOf(float t) {
    const uint bits = floatBitsToUint(t);
    return (bits & 0x80000000u) != 0u ? ~bits : bits | 0x80000000u;
}

void main() {
    const FrameParams frame = push.frame.frame;
    const GlyphLayerParams layer = push.layer.layer;
    const uvec2 pixel = uvec2(gl_FragCoord.xy);
    const uint at = pixel.y * frame.width + pixel.x;
    ray = pixelRay(frame.rays, vec2(frame.width, frame.height), vec2(pixel) + 0.5 + frame.jitter);
    ray_inverse = inverseDirection(ray.direction);
    best_t = ray.far;
    best_instance = 0xffffffffu;
    if (!kFirstLayer) best_t = min(best_t, push.surface.at[at].depth);
    words = uvec4(0u);
    gl_FragDepth = 0.0;  // nothing: not greater than what was there
    const GlyphInstance instance = InstanceBuffer(layer.instances).at[glyph];
    const vec3 centre = instanceCentre(frame.rays, instance);
    const vec2 span = boxSpan(ray.origin - centre, ray_inverse, instance.box_min, instance.box_max);
    if (!(span.x <= span.y && span.x < best_t && span.y >= ray.near) || orderOf(span.x) > push.nearest.at[at]) return;
    if (kBoxesOnly) {
        // Something must be written, or the work is optimised away.
        if (span.x == 1e30) push.steps.at[at] = 1u;
        return;
    }
    intersectInstance(frame, layer, glyph, instance, centre);
    atomicAdd(push.steps.at[at], total_steps);
    if (capped_rays > 0u) atomicAdd(push.counters.capped_rays, capped_rays);
    if (best_instance == 0xffffffffu) return;
    atomicMin(push.nearest.at[at], orderOf(best_t));
    gl_FragDepth = depthOfParameter(best_t);
    loadCoefficients(layer.coefficients, layer.stride, instance.slot);
    const vec3 normal = glyphNormal(shEvaluateGradient(glyph_coefficients, best_direction), best_direction);
    words = uvec4(glyph, floatBitsToUint(dot(normal, ray.direction) > 0.0 ? -normal : normal));
}
