// Camera paths around a scene, with the same mathematics as the server's (model/camera.h).
#pragma once

#include <vector>

#include "radiata/v1/camera.pb.h"

namespace radiata::client {

/// `count` cameras, the first being `start`; each turns by the given angles from `start` as model::orbit does.
/// \throws ClientError(kUsage) naming the field if the camera is no valid one
std::vector<v1::Camera> orbitPath(const v1::Camera& start, int count, double azimuth_step_deg, double elevation_step_deg);

}  // namespace radiata::client
