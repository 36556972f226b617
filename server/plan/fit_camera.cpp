#include "plan/fit_camera.h"

#include <algorithm>
#include <cmath>

namespace radiata::plan {
namespace {

/// From where one looks (unit, from the target to the eye) and what is up.
void viewAxes(const model::VoxelSelection& selection, model::Convention convention, glm::dvec3& towards_eye, glm::dvec3& up) {
    const bool radiological = convention == model::Convention::kRadiological;
    up = {0, 0, 1};
    switch (selection.plane) {
        case model::Plane::kAxial:
            towards_eye = {0, 0, radiological ? -1.0 : 1.0};
            up = {0, 1, 0};
            return;
        case model::Plane::kCoronal:
            towards_eye = {0, radiological ? 1.0 : -1.0, 0};
            return;
        case model::Plane::kSagittal:
            towards_eye = {-1, 0, 0};
            return;
        case model::Plane::kOblique: {
            towards_eye = glm::normalize(selection.normal);
            if (radiological && std::abs(towards_eye.z) > 0.7) towards_eye = towards_eye.z > 0 ? -towards_eye : towards_eye;
            if (std::abs(towards_eye.z) > 0.7) up = {0, 1, 0};
            return;
        }
    }
}

}  // namespace

model::Camera fitCamera(const SceneBounds& bounds, const model::VoxelSelection& selection, model::Convention convention,
                        double aspect) {
    glm::dvec3 towards_eye(0, 0, 1), up(0, 1, 0);
    viewAxes(selection, convention, towards_eye, up);
    model::Camera camera;
    camera.target_mm = bounds.centre();
    camera.up = up;
    camera.eye_mm = camera.target_mm + towards_eye * std::max(2 * bounds.radius(), 1.0);
    const model::CameraFrame axes = model::cameraFrame(camera);
    const glm::dvec3 extent = bounds.maximum - bounds.minimum;
    const double width = glm::dot(extent, glm::abs(axes.right)), height = glm::dot(extent, glm::abs(axes.up));
    camera.height_mm = std::max(1.02 * std::max(height, width / aspect), 1e-3);
    return camera;
}

}  // namespace radiata::plan
