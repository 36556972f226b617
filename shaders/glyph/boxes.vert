// The certified box of each listed glyph as eight corners, grown so that the rasteriser covers every pixel centre whose ray meets
// it. Back faces are drawn: each such ray leaves through one of them in front of the eye, from inside of the box too.
// Source: Peters et al. 2023, Sec. 5 ("rasterizing the AABBs is a viable alternative" to ray queries).
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/frame.glsl"
#include "shaders/shared/glyph.glsl"
#include "shaders/shared/raster.glsl"

layout(buffer_reference, scalar) readonly buffer FrameBuffer { FrameParams frame; };
layout(buffer_reference, scalar) readonly buffer LayerBuffer { GlyphLayerParams layer; };
layout(buffer_reference, scalar) readonly buffer InstanceBuffer { GlyphInstance at[]; };
layout(buffer_reference, scalar) readonly buffer ViewBuffer { RasterView view; };
layout(buffer_reference, scalar) readonly buffer ListBuffer { uint at[]; };

layout(push_constant, scalar) uniform Push {  // the beginning of that of boxes.frag
    FrameBuffer frame;
    LayerBuffer layer;
    ViewBuffer view;
    ListBuffer list;
} push;

layout(location = 0) flat out uint glyph;

void main() {
    const CameraRays rays = push.frame.frame.rays;
    const RasterView view = push.view.view;
    glyph = push.list.at[gl_InstanceIndex];
    const GlyphInstance instance = InstanceBuffer(push.layer.layer.instances).at[glyph];
    const vec3 centre = (instance.centre_high - rays.reference_high) + (instance.centre_low - rays.reference_low);
    // A pixel covers more the farther it is; that of the farthest corner serves for all.
    const float reach = length(max(abs(instance.box_min), abs(instance.box_max)));
    const float nearness = max(1.0 + (dot(centre, rays.forward) + reach) * rays.inverse_distance, 0.0);
    const float margin = view.margin * nearness + 1e-6 * (length(centre) + reach);
    const bvec3 upper = bvec3((gl_VertexIndex & 1) != 0, (gl_VertexIndex & 2) != 0, (gl_VertexIndex & 4) != 0);
    const vec4 corner = vec4(centre + mix(instance.box_min - margin, instance.box_max + margin, upper), 1.0);
    // Depth comes from the hit; the corner's own only has to pass the clip planes wherever it is in front of the eye.
    const float w = dot(view.row_w, corner);
    gl_Position = vec4(dot(view.row_x, corner), dot(view.row_y, corner), 0.5 * w, w);
}
