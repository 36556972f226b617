// Light on what fiblets won, where they are all that a picture of one sample shows: in place of surface.comp and frame/light.comp,
// between which the surface buffer would be written and read once, and with their bytes. One invocation per pixel.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_ballot : require
#include "shaders/common/invocation.glsl"
#include "shaders/fiblet/layer.glsl"
#include "shaders/shared/frame.glsl"
#include "shaders/fiblet/pixel_stretch.glsl"
#include "shaders/common/camera_rays.glsl"
#include "shaders/common/base_colour.glsl"
#include "shaders/common/fibre_colour.glsl"
#include "shaders/common/light_visibility.glsl"

layout(constant_id = 1) const bool kMarks = false;
layout(constant_id = 3) const bool kTubes = false;

layout(buffer_reference, scalar) readonly buffer FrameBuffer { FrameParams frame; };
layout(buffer_reference, scalar) readonly buffer LookBuffer { LayerLook at[]; };
layout(buffer_reference, scalar) writeonly buffer PictureBuffer { uint rgba[]; };
layout(buffer_reference, scalar) buffer FrameCountersBuffer { uint hit_pixels; };
#include "shaders/fiblet/won.glsl"

layout(push_constant, scalar) uniform Push {
    LayerBuffer layer;
    FrameBuffer frame;
    LookBuffer looks;
    PictureBuffer picture;
    FrameCountersBuffer counters;  // null: pixels are lit once more
} push;

// Radiance towards the viewer. \param at  the pixel \param depth  of its ray \param direction  as raster.comp packs it
vec3 litFibre(FrameParams frame, LayerLook look, uint at, uint who, float depth, uint direction) {
    const vec2 point = vec2(pixelPlace(at, frame.width)) + 0.5 + frame.jitter;
    const PixelRay ray = pixelRay(frame.rays, vec2(frame.width, frame.height), point);
    bool line;
    float dimmed;
    vec3 along = lineTangent(direction);
    const vec3 base = fibreColour(look, 0u, who, ray.origin + depth * ray.direction, along, at, line, dimmed);
    BitBuffer none = BitBuffer(0ul);  // no ray is blocked
    if (!kTubes || line) return dimmed * shadeLine(frame, none, none, at, base, 0.45, along, -ray.direction);
    return dimmed * shadeVisible(frame, none, none, at, base, 0.45, tubeNormal(direction), -ray.direction);
}

void main() {
    // Before all branches, where a CPU driver reads for a fraction of the time.
    const FibletLayerParams layer = push.layer.layer;
    const FrameParams frame = push.frame.frame;
    const LayerLook look = push.looks.at[0];
    const uint pixels = frame.width * frame.height, at = min(globalInvocation(), pixels - 1u);
    const uint64_t word = WordBuffer(layer.words).at[at], tangent = WordBuffer(layer.tangents).at[at];
    if (globalInvocation() >= pixels) return;
    vec3 radiance = frame.background;
    const uint who = uint(word);
    if (who != FIBLET_NOBODY) {
        const uint hits = subgroupBallotBitCount(subgroupBallot(uint64_t(push.counters) != 0ul));
        if (subgroupElect() && hits > 0u) atomicAdd(push.counters.hit_pixels, hits);
        if (kMarks) markSeen(layer, who);
        if (uint(tangent) == who) {
            const float depth = depthOfOrder(uint(word >> 32)) * pixelStretch(layer.view, at);
            radiance = litFibre(frame, look, at, who, depth, uint(tangent >> 32));
        } else {
            drawAgain(layer, who);
        }
    }
    push.picture.rgba[at] = packedColour(srgbFromLinear(min(radiance, vec3(1.0))));
}
