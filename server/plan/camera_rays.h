// The camera in the form that shaders use: rebased in double to a reference point on the line of sight inside the scene.
#pragma once

#include <glm/glm.hpp>

#include "model/camera.h"
#include "shaders/shared/frame.glsl"

namespace radiata::plan {

/// World-space box, mm.
struct SceneBounds {
    glm::dvec3 minimum{0}, maximum{0};
    glm::dvec3 centre() const { return 0.5 * (minimum + maximum); }
    double radius() const { return 0.5 * glm::length(maximum - minimum); }
};

struct RebasedCamera {
    shader::CameraRays rays{};
    glm::dvec3 reference_mm{0};  ///< world
    double depth_offset_mm = 0;  ///< from the eye to the reference plane along the line of sight
    bool sees_scene = true;      ///< false: all of the scene is behind the eye or outside the clip planes
};

/// \param scene  bounds of everything shown; boxes on the device are relative to its centre
/// \param height  of the picture, pixels; pixels are square
/// Pixel rays are exact to float rounding of positions near the reference point: cameras a kilometre away with a lens to match
/// see what near ones see (tests/unit/plan/camera_rays_test.cpp).
RebasedCamera rebaseCamera(const model::Camera& camera, const SceneBounds& scene, int height);

}  // namespace radiata::plan
