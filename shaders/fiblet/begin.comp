// Words of pixels before a layer's fiblets are drawn: the depth of what earlier layers show there, and nobody. Where there are none,
// the words are filled with ones without a pass: no depth has as high an order.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/common/invocation.glsl"
#include "shaders/fiblet/layer.glsl"
#include "shaders/shared/frame.glsl"
#include "shaders/fiblet/pixel_stretch.glsl"

layout(constant_id = 1) const bool kCounting = false;  // segments before what is opaque will be counted

layout(buffer_reference, scalar) readonly buffer SurfaceBuffer { Surface at[]; };
layout(push_constant, scalar) uniform Push {
    LayerBuffer layer;
    SurfaceBuffer surface;
    SurfaceBuffer opaque;  // the same, but for transparent layers, which begin from what others have found
} push;

void main() {
    const FibletLayerParams layer = push.layer.layer;
    const uint at = globalInvocation();
    if (at >= uint(layer.view.width * layer.view.height)) return;
    const float stretch = pixelStretch(layer.view, at);
    const float depth = min(push.surface.at[at].depth, push.opaque.at[at].depth) / stretch;
    const uint64_t word = uint64_t(orderOfDepth(depth)) << 32 | FIBLET_NOBODY;
    WordBuffer(layer.words).at[at] = word;
    if (kCounting) {
        WordBuffer(layer.peeled).at[at] = uint64_t(orderOfDepth(push.opaque.at[at].depth / stretch)) << 32 | FIBLET_NOBODY;
        UintBuffer(layer.fragments).at[at] = 0u;
    }
}
