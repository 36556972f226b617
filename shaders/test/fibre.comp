// Runs capsule.glsl, depth_order.glsl, fibre_directions.glsl and fiblet_projection.glsl over an array.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/test/function.glsl"
#include "shaders/test/fibre_io.glsl"
#include "shaders/common/capsule.glsl"
#include "shaders/common/depth_order.glsl"
#include "shaders/common/fibre_directions.glsl"
#include "shaders/common/fiblet_projection.glsl"

FUNCTION_OVER(FibreInput, FibreOutput)

FibreOutput function(FibreInput x) {
    FibreOutput result;
    result.capsule = capsuleHit(x.origin, x.direction, x.start, x.along, x.radius, x.nearest, result.normal);
    result.order = orderOfDepth(x.depth);
    result.ordered = depthOfOrder(result.order);
    result.line_tangent = lineTangent(packLine(x.direction));
    const uint tube = packTube(x.along, result.normal);
    result.tube_tangent = tubeTangent(tube);
    result.tube_normal = tubeNormal(tube);
    const vec4 eye = fibletEyePoint(x.view, x.start);
    const vec2 pixel = fibletPixel(x.view, eye);
    result.column = pixel.x;
    result.row = pixel.y;
    result.eye_depth = eye.z;
    const FibletFootprint footprint = fibletFootprint(x.view, min(x.start, x.start + x.along), max(x.start, x.start + x.along), 0.0, 0.0);
    result.seen = footprint.seen ? 1u : 0u;
    result.first_column = footprint.pixels.x;
    result.first_row = footprint.pixels.y;
    result.last_column = footprint.pixels.z;
    result.last_row = footprint.pixels.w;
    result.nearest = footprint.nearest;
    return result;
}

FUNCTION_MAIN
