// The camera's rays as the projection that fiblets are drawn and culled by.
#pragma once

#include <span>

#include "shaders/shared/fiblet_draw.glsl"
#include "shaders/shared/frame.glsl"

namespace radiata::plan {

/// Part of a picture that is drawn, pixels from its upper left corner.
struct PixelWindow {
    glm::ivec2 first{0};
    glm::ivec2 size{0};
};

/// Points on the ray through picture point (column + 0.5 + jitter.x, row + 0.5 + jitter.y) are drawn at the centre of that
/// pixel, with the same bits whatever the window is. Depths are those of the rays (shaders/shared/frame.glsl), from the near
/// plane or, inside of a perspective view, 1e-5 of the distance before the eye. \param picture      columns and rows of the
/// whole \param reference_from_origin  from the origin that drawn points count from to the rays' reference point, mm \param
/// reach_mm     largest distance of drawn points from that origin Off by less than 1e-3 pixels on float hardware for cameras
/// that see less than 1e5 pixels of the scene.
shader::FibletView fibletView(const shader::CameraRays& rays, const glm::ivec2& picture, const PixelWindow& window,
                              const glm::vec2& jitter, const glm::dvec3& reference_from_origin, double reach_mm);

/// Whether nearly all pages are in the picture, by their boxes' middles: to list what is in it takes longer then than to draw
/// what is beside it too.
bool areInside(const shader::FibletView& view, std::span<const shader::FibletPage> pages);

}  // namespace radiata::plan
