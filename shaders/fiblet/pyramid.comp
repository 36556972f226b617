// One level of the depth pyramid: the farthest order of depths of 2x2 entries of the level below, the first of words of pixels.
// Sizes are rounded up, so every pixel is under one entry of each level.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/common/pixel_place.glsl"
#include "shaders/common/invocation.glsl"
#include "shaders/fiblet/layer.glsl"

layout(constant_id = 1) const bool kFromWords = true;

layout(push_constant, scalar) uniform Push {
    LayerBuffer layer;
    uint source;  // offsets of the levels in the pyramid
    uint target;
    ivec2 source_size;
} push;

uint farthest(FibletLayerParams layer, ivec2 at) {
    const ivec2 inside = min(at, push.source_size - 1);
    const uint index = uint(inside.y * push.source_size.x + inside.x);
    return kFromWords ? uint(WordBuffer(layer.words).at[index] >> 32) : UintBuffer(layer.pyramid).at[push.source + index];
}

void main() {
    const FibletLayerParams layer = push.layer.layer;
    const ivec2 size = (push.source_size + 1) / 2;
    const int at = int(globalInvocation());
    if (at >= size.x * size.y) return;
    const ivec2 corner = 2 * pixelPlace(uint(at), uint(size.x));
    UintBuffer(layer.pyramid).at[push.target + uint(at)] =
        max(max(farthest(layer, corner), farthest(layer, corner + ivec2(1, 0))),
            max(farthest(layer, corner + ivec2(0, 1)), farthest(layer, corner + ivec2(1, 1))));
}
