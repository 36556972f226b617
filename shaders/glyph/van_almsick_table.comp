// Rotates each glyph's coefficients for the frame's camera, for van Almsick's method: one invocation per glyph.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/common/invocation.glsl"
#include "shaders/glyph/layer.glsl"
#include "van_almsick.glsl"

layout(push_constant, scalar) uniform Push {
    FrameBuffer frame;
    LayerBuffer layer;
} push;

void main() {
    const GlyphLayerParams layer = push.layer.layer;
    const uint index = globalInvocation();
    if (index >= layer.count) return;
    const GlyphInstance instance = InstanceBuffer(layer.instances).at[index];
    loadCoefficients(layer.coefficients, layer.stride, instance.slot);
    const CameraRays rays = push.frame.frame.rays;
    float table[VAN_ALMSICK_COUNT];
    vanAlmsickTable(glyph_coefficients, poleAxis(rays, instanceCentre(rays, instance)), table);
    FloatBuffer target = FloatBuffer(layer.tables + uint64_t(index) * uint64_t(VAN_ALMSICK_COUNT * 4));
    for (int i = 0; i < VAN_ALMSICK_COUNT; ++i) target.at[i] = table[i];
}
