// Rays of a camera through its pixels, and back, in double world coordinates. Twin of the rebased float32 rays of the frame.
#pragma once

#include <glm/glm.hpp>

#include "model/camera.h"

namespace radiata::reference {

struct Ray {
    glm::dvec3 origin{0};           ///< world mm: the eye, or for orthographic cameras the point of the eye's plane
    glm::dvec3 direction{0, 0, 1};  ///< unit
};

/// \param x, y  in pixels from the picture's left and top edge; the centre of the first pixel is (0.5, 0.5)
/// \throws Error(kInvalidArgument) as model::cameraFrame
Ray cameraRay(const model::Camera& camera, int width, int height, double x, double y);

/// Where a world point appears: x, y in pixels as above, z its distance along the line of sight in mm (negative: behind).
glm::dvec3 projectPoint(const model::Camera& camera, int width, int height, const glm::dvec3& point_mm);

}  // namespace radiata::reference
