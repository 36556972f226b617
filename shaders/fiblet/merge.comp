// What the device's rasteriser has drawn of a layer, into the words that all pipelines leave: one invocation per pixel.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/common/invocation.glsl"
#include "shaders/fiblet/layer.glsl"

layout(buffer_reference, scalar) readonly buffer ImageBuffer { uvec4 at[]; };
layout(push_constant, scalar) uniform Push {
    LayerBuffer layer;
    ImageBuffer image;  // as line.frag writes them; all 0 where nothing was drawn
    UintBuffer depth;
} push;

void main() {
    const FibletLayerParams layer = push.layer.layer;
    const uint at = globalInvocation();
    if (at >= uint(layer.view.width * layer.view.height) || push.depth.at[at] == 0u) return;
    const uvec4 drawn = push.image.at[at];
    const uint64_t word = uint64_t(orderOfDepth(uintBitsToFloat(drawn.y))) << 32 | drawn.x;
    if (word >= WordBuffer(layer.words).at[at]) return;
    WordBuffer(layer.words).at[at] = word;
    WordBuffer(layer.tangents).at[at] = uint64_t(drawn.z) << 32 | drawn.x;
}
