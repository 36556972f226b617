// What drawing glyphs as triangles reads: the camera as a matrix, and the layout of what is drawn.
#ifndef RADIATA_SHARED_RASTER
#define RADIATA_SHARED_RASTER
#include "shaders/shared/interop.glsl"
SHADER_NAMESPACE_BEGIN

// The rays of one sample as a projection of points p relative to the reference point: clip.c = dot(row.c, (p, 1)). Pixel centres
// see the points on their rays; depth falls from 1 at the near plane to 0 at the far one. Made by plan/raster_view.
struct RasterView {
    vec4 row_x;
    vec4 row_y;
    vec4 row_z;
    vec4 row_w;
    float margin;  // of boxes, mm on the reference plane: covers what rasterisers round
    float pad0;
    float pad1;
    float pad2;
};
STATIC_SIZE(RasterView, 80);

// A corner of a deformed sphere.
struct MeshVertex {
    vec3 offset;  // from the glyph's centre, mm
    vec3 normal;  // unit, outwards
};
STATIC_SIZE(MeshVertex, 24);

SHADER_NAMESPACE_END
#endif
