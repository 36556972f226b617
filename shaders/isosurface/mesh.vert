// Corners of an isosurface's triangles, as server/build/marching_cubes made them, through the projection of the frame's rays.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/frame.glsl"
#include "shaders/shared/raster.glsl"
#include "shaders/shared/surface_mesh.glsl"

layout(buffer_reference, scalar) readonly buffer MeshBuffer { SurfaceMeshParams mesh; };
layout(buffer_reference, scalar) readonly buffer ViewBuffer { RasterView view; };
layout(buffer_reference, scalar) readonly buffer CornerBuffer { SurfaceCorner at[]; };

layout(push_constant, scalar) uniform Push {  // the beginning of that of mesh.frag
    uint64_t frame;
    MeshBuffer mesh;
    ViewBuffer view;
} push;

layout(location = 0) out vec3 place;   // relative to the frame's reference point, mm
layout(location = 1) out vec3 normal;  // world

void main() {
    const SurfaceMeshParams mesh = push.mesh.mesh;
    const RasterView view = push.view.view;
    const SurfaceCorner corner = CornerBuffer(mesh.corners).at[gl_VertexIndex];
    const vec3 grid = (corner.position - vec3(mesh.base)) - mesh.fraction;
    place = mesh.mm_x * grid.x + mesh.mm_y * grid.y + mesh.mm_z * grid.z;
    normal = vec3(dot(mesh.grid_x, corner.normal), dot(mesh.grid_y, corner.normal), dot(mesh.grid_z, corner.normal));
    const vec4 p = vec4(place, 1.0);
    gl_Position = vec4(dot(view.row_x, p), dot(view.row_y, p), dot(view.row_z, p), dot(view.row_w, p));
}
