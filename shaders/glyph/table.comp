// Builds the pole-frame table of each glyph for the frame's camera, or for rays towards its light: one invocation per glyph.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/common/invocation.glsl"
#include "shaders/glyph/layer.glsl"

layout(constant_id = 20) const bool kTowardsLight = false;

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
    float table[POLE_TABLE_COUNT];
    const vec3 axis = kTowardsLight ? -push.frame.frame.light_direction : poleAxis(rays, instanceCentre(rays, instance));
    poleTableBuild(glyph_coefficients, axis, table);
    FloatBuffer target = FloatBuffer((kTowardsLight ? layer.sun_tables : layer.tables) + uint64_t(index) * uint64_t(POLE_TABLE_COUNT * 4));
    for (int i = 0; i < POLE_TABLE_COUNT; ++i) target.at[i] = table[i];
}
