// Where on the shown surface a pixel's hit lies, from its depth.
#ifndef RADIATA_ISOSURFACE_HIT_POINT
#define RADIATA_ISOSURFACE_HIT_POINT
#include "shaders/common/pixel_place.glsl"
#include "shaders/shared/frame.glsl"
#include "shaders/common/camera_rays.glsl"
#include "shaders/isosurface/level_set.glsl"

GridPoint hitPoint(FrameParams frame, IsosurfaceParams layer, uint pixel, float depth) {
    const vec2 point = vec2(pixelPlace(pixel, frame.width)) + 0.5 + frame.jitter;
    const PixelRay ray = pixelRay(frame.rays, vec2(frame.width, frame.height), point);
    const vec3 offset = layer.fraction + gridVector(layer.volume, ray.origin + depth * ray.direction);
    return gridPoint(layer.volume, layer.base, offset);
}

#endif
