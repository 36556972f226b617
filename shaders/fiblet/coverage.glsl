// The coverage buffer as its passes read it.
#include "shaders/fiblet/layer.glsl"
#include "shaders/shared/fiblet_coverage.glsl"
#include "shaders/common/fiblet_sprite.glsl"

layout(buffer_reference, scalar) readonly buffer CoverageBuffer { FibletCoverageParams params; };
layout(push_constant, scalar) uniform Push {
    LayerBuffer layer;
    CoverageBuffer coverage;
    uint first;  // fiblet, where there is one invocation per fiblet
} push;

// Column and row in the whole picture.
vec2 texelCentre(FibletView view, ivec2 texel) {
    return vec2(view.window_x, view.window_y) + (vec2(texel) + 0.5) * float(FIBLET_TEXEL);
}
