#include "model/camera.h"

#include <cmath>
#include <numbers>
#include <sstream>
#include <string>

#include <glm/gtc/quaternion.hpp>

#include "base/error.h"

namespace radiata::model {
namespace {

/// Up to here a step of a double is below 0.2 um, so that a far eye still tells one glyph from the next.
constexpr double kFarthestMm = 1e12;

bool finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

std::string text(const glm::dvec3& v) {
    std::ostringstream out;
    out << "(" << v.x << ", " << v.y << ", " << v.z << ")";
    return out.str();
}

[[noreturn]] void refuse(const std::string& message) { throw Error(Code::kInvalidArgument, "camera: " + message); }

void checkPlace(const glm::dvec3& place, const std::string& field) {
    if (!finite(place)) refuse(field + " is " + text(place) + "; it must be finite");
    for (int c = 0; c < 3; ++c) {
        if (std::abs(place[c]) > kFarthestMm) refuse(field + " is " + text(place) + "; at most 1e12 mm from 0 are drawn");
    }
}

void checkLens(const Camera& camera) {
    if (camera.perspective) {
        if (!(camera.field_of_view_deg > 0 && camera.field_of_view_deg < 179)) {
            refuse("field_of_view_deg is " + std::to_string(camera.field_of_view_deg) + "; it must be above 0 and below 179");
        }
    } else if (!(camera.height_mm > 0 && std::isfinite(camera.height_mm))) {
        refuse("height_mm is " + std::to_string(camera.height_mm) + "; it must be finite and above 0");
    }
    if (camera.clip && !(camera.clip->nearest_mm >= 0 && camera.clip->nearest_mm < camera.clip->farthest_mm &&
                         std::isfinite(camera.clip->farthest_mm))) {
        refuse("clip is " + std::to_string(camera.clip->nearest_mm) + " to " + std::to_string(camera.clip->farthest_mm) +
               " mm; 0 <= nearest_mm < farthest_mm must hold");
    }
}

}  // namespace

CameraFrame cameraFrame(const Camera& camera) {
    checkPlace(camera.eye_mm, "eye_mm");
    checkPlace(camera.target_mm, "target_mm");
    if (!finite(camera.up)) refuse("up is " + text(camera.up) + "; it must be finite");
    checkLens(camera);
    const glm::dvec3 sight = camera.target_mm - camera.eye_mm;
    const double distance = glm::length(sight);
    if (!(distance > 0) || !std::isfinite(distance)) {
        refuse("eye_mm and target_mm are both " + text(camera.eye_mm) + "; they must differ");
    }
    const glm::dvec3 forward = sight / distance;
    const double up_length = glm::length(camera.up);
    if (!(up_length > 0) || !std::isfinite(up_length)) refuse("up is " + text(camera.up) + "; it must not be zero");
    const glm::dvec3 right = glm::cross(forward, camera.up / up_length);
    if (!(glm::length(right) > 1e-9)) {
        refuse("up " + text(camera.up) + " is parallel to the line of sight " + text(forward) + "; it must not be");
    }
    CameraFrame frame;
    frame.forward = forward;
    frame.right = glm::normalize(right);
    frame.up = glm::cross(frame.right, forward);
    return frame;
}

Camera orbit(const Camera& camera, double azimuth_deg, double elevation_deg) {
    constexpr double kRadians = std::numbers::pi / 180;
    const CameraFrame frame = cameraFrame(camera);
    const glm::dquat turn = glm::angleAxis(azimuth_deg * kRadians, frame.up);
    const glm::dvec3 right = turn * frame.right;
    const glm::dquat both = glm::angleAxis(elevation_deg * kRadians, right) * turn;
    Camera turned = camera;
    turned.eye_mm = camera.target_mm + both * (camera.eye_mm - camera.target_mm);
    turned.up = both * frame.up;
    return turned;
}

}  // namespace radiata::model
