// Vertices of deformed spheres, as tessellate.comp left them, through the projection of the frame's rays.
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
layout(buffer_reference, scalar) readonly buffer VertexBuffer { MeshVertex at[]; };

layout(push_constant, scalar) uniform Push {  // the beginning of that of mesh.frag
    FrameBuffer frame;
    LayerBuffer layer;
    ViewBuffer view;
    ListBuffer list;
    VertexBuffer vertices;
    uint first;         // of the list's glyphs in the vertex buffer
    uint vertex_count;  // per glyph
} push;

layout(location = 0) flat out uint glyph;
layout(location = 1) flat out vec3 centre;
layout(location = 2) out vec3 offset;
layout(location = 3) out vec3 normal;

void main() {
    const CameraRays rays = push.frame.frame.rays;
    const RasterView view = push.view.view;
    glyph = push.list.at[push.first + gl_InstanceIndex];
    const GlyphInstance instance = InstanceBuffer(push.layer.layer.instances).at[glyph];
    centre = (instance.centre_high - rays.reference_high) + (instance.centre_low - rays.reference_low);
    const MeshVertex vertex = push.vertices.at[gl_InstanceIndex * push.vertex_count + gl_VertexIndex];
    offset = vertex.offset;
    normal = vertex.normal;
    const vec4 p = vec4(centre + vertex.offset, 1.0);
    gl_Position = vec4(dot(view.row_x, p), dot(view.row_y, p), dot(view.row_z, p), dot(view.row_w, p));
}
