// From where a scene is seen. World space, mm, double: a camera may stand a kilometre away.
#pragma once

#include <optional>

#include <glm/glm.hpp>

namespace radiata::model {

struct Clip {
    double nearest_mm = 0;
    double farthest_mm = 0;
    bool operator==(const Clip&) const = default;
};

struct Camera {
    glm::dvec3 eye_mm{0, 0, 1};
    glm::dvec3 target_mm{0};
    glm::dvec3 up{0, 1, 0};
    bool perspective = false;
    double field_of_view_deg = 30;  ///< full vertical angle, perspective only
    double height_mm = 100;         ///< of the picture, orthographic only
    std::optional<Clip> clip;
    bool operator==(const Camera&) const = default;
};

/// The camera's axes in world space: unit, right-handed; forward points into the picture.
struct CameraFrame {
    glm::dvec3 right, up, forward;
};

/// \throws Error(kInvalidArgument) naming the field if anything is not finite, eye and target coincide, up is zero or parallel
///         to the line of sight, the lens is out of range, or the clip distances are not 0 <= nearest < farthest.
CameraFrame cameraFrame(const Camera& camera);

/// The camera turned about its target: `azimuth_deg` about the camera's up axis, then `elevation_deg` about its right axis.
Camera orbit(const Camera& camera, double azimuth_deg, double elevation_deg);

}  // namespace radiata::model
