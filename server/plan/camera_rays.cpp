#include "plan/camera_rays.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "math/two_floats.h"

namespace radiata::plan {
namespace {

/// Extent of the scene along the line of sight, from the eye.
void depthRange(const glm::dvec3& eye, const glm::dvec3& forward, const SceneBounds& scene, double& nearest, double& farthest) {
    const glm::dvec3 half = 0.5 * (scene.maximum - scene.minimum);
    const double middle = glm::dot(scene.centre() - eye, forward);
    const double reach = glm::dot(half, glm::abs(forward)) * (1 + 1e-6) + 1e-6;
    nearest = middle - reach;
    farthest = middle + reach;
}

}  // namespace

RebasedCamera rebaseCamera(const model::Camera& camera, const SceneBounds& scene, int height) {
    const model::CameraFrame frame = model::cameraFrame(camera);
    double nearest = 0, farthest = 0;
    depthRange(camera.eye_mm, frame.forward, scene, nearest, farthest);
    double first = std::max(nearest, camera.perspective ? 0.0 : nearest), last = farthest;
    if (camera.clip) {
        first = std::max(first, camera.clip->nearest_mm);
        last = std::min(last, camera.clip->farthest_mm);
    }
    RebasedCamera rebased;
    rebased.sees_scene = last > first;
    // The reference point: where the camera looks, moved into the visible part of the scene. Never at the eye itself.
    const double wanted = glm::dot(camera.target_mm - camera.eye_mm, frame.forward);
    double distance = rebased.sees_scene ? std::clamp(wanted, first, last) : wanted;
    if (camera.perspective) distance = std::max(distance, 1e-3 * std::max(scene.radius(), 1e-3));
    rebased.depth_offset_mm = distance;
    rebased.reference_mm = camera.eye_mm + distance * frame.forward;

    double height_mm = camera.height_mm;
    if (camera.perspective) height_mm = 2 * distance * std::tan(0.5 * camera.field_of_view_deg * std::numbers::pi / 180);
    const double step = height_mm / height;
    shader::CameraRays& rays = rebased.rays;
    rays.step_right = glm::vec3(frame.right * step);
    rays.step_up = glm::vec3(frame.up * step);
    rays.forward = glm::vec3(frame.forward);
    rays.inverse_distance = camera.perspective ? static_cast<float>(1 / distance) : 0.0F;
    rays.near_depth = static_cast<float>(first - distance);
    rays.far_depth = static_cast<float>(last - distance);
    const glm::dvec3 from_centre = rebased.reference_mm - scene.centre();
    rays.scene_from_reference = glm::vec3(from_centre);
    const TwoFloats reference = twoFloats(from_centre);
    rays.reference_high = reference.high;
    rays.reference_low = reference.low;
    return rebased;
}

}  // namespace radiata::plan
