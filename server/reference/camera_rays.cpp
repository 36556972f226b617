#include "reference/camera_rays.h"

#include <cmath>
#include <numbers>

namespace radiata::reference {
namespace {

/// Height in world mm that the picture covers at unit distance (perspective) or at any (orthographic).
double pictureHeight(const model::Camera& camera) {
    return camera.perspective ? 2 * std::tan(camera.field_of_view_deg * std::numbers::pi / 360) : camera.height_mm;
}

}  // namespace

Ray cameraRay(const model::Camera& camera, int width, int height, double x, double y) {
    const model::CameraFrame frame = model::cameraFrame(camera);
    const double pixel = pictureHeight(camera) / height;
    const glm::dvec3 offset = (x - width / 2.0) * pixel * frame.right + (height / 2.0 - y) * pixel * frame.up;
    if (camera.perspective) return {camera.eye_mm, glm::normalize(frame.forward + offset)};
    return {camera.eye_mm + offset, frame.forward};
}

glm::dvec3 projectPoint(const model::Camera& camera, int width, int height, const glm::dvec3& point_mm) {
    const model::CameraFrame frame = model::cameraFrame(camera);
    const glm::dvec3 from_eye = point_mm - camera.eye_mm;
    const double distance = glm::dot(from_eye, frame.forward);
    const double pixel = pictureHeight(camera) / height * (camera.perspective ? distance : 1.0);
    return {width / 2.0 + glm::dot(from_eye, frame.right) / pixel, height / 2.0 - glm::dot(from_eye, frame.up) / pixel,
            distance};
}

}  // namespace radiata::reference
