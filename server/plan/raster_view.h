// The camera's rays as a projection matrix for the rasteriser.
#pragma once

#include "shaders/shared/frame.glsl"
#include "shaders/shared/raster.glsl"

namespace radiata::plan {

/// Points on the ray through picture point (column + 0.5 + jitter.x, row + 0.5 + jitter.y) are drawn at the centre of pixel
/// (column, row), for perspective and orthographic rays. Where the eye stands in the scene, the near plane is 1e-5 of the
/// distance to the reference plane in front of it, as depth cannot begin at the eye. Made in double from the rays that other
/// passes trace; off by less than 1e-3 pixels on float hardware (tests/unit/plan/raster_view_test.cpp).
shader::RasterView rasterView(const shader::CameraRays& rays, int width, int height, const glm::vec2& jitter);

}  // namespace radiata::plan
