#include "common/camera_orbit.h"

#include "base/error.h"
#include "common/client_error.h"
#include "model/camera.h"

namespace radiata::client {
namespace {

glm::dvec3 toModel(const v1::Vec3& v) { return {v.x(), v.y(), v.z()}; }

void setVector(v1::Vec3& vector, const glm::dvec3& v) {
    vector.set_x(v.x);
    vector.set_y(v.y);
    vector.set_z(v.z);
}

}  // namespace

std::vector<v1::Camera> orbitPath(const v1::Camera& start, int count, double azimuth_step_deg, double elevation_step_deg) {
    // The lens and the clip distances do not take part in an orbit and are kept as they are.
    model::Camera camera;
    camera.eye_mm = toModel(start.eye_mm());
    camera.target_mm = toModel(start.target_mm());
    camera.up = toModel(start.up());
    std::vector<v1::Camera> cameras;
    cameras.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) {
        cameras.push_back(start);
        if (i == 0) continue;
        try {
            const model::Camera turned = model::orbit(camera, i * azimuth_step_deg, i * elevation_step_deg);
            setVector(*cameras.back().mutable_eye_mm(), turned.eye_mm);
            setVector(*cameras.back().mutable_up(), turned.up);
        } catch (const Error& error) {
            throw ClientError(ExitCode::kUsage, error.what());
        }
    }
    return cameras;
}

}  // namespace radiata::client
