// Cameras and camera paths as JSON; docs/formats/camera.md describes the format. The Python package reads the same files.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "radiata/v1/camera.pb.h"

namespace radiata::client {

/// \param where  name of the file or option, for messages
/// \throws ClientError(kUsage) naming the field if a required one is missing, has another type, or is not known.
///         Ranges are the server's business: it refuses with a sentence of its own.
v1::Camera cameraFromJson(const nlohmann::json& json, const std::string& where);
nlohmann::json cameraToJson(const v1::Camera& camera);

/// \param text  a JSON object, or the name of a file that holds one
/// \throws ClientError(kUsage)
v1::Camera cameraFromOption(const std::string& text);

/// A list of cameras, or an object with the list "cameras". At least one, at most 100,000.
/// \throws ClientError(kUsage)
std::vector<v1::Camera> readCameraPath(const std::string& file);
nlohmann::json cameraPathToJson(const std::vector<v1::Camera>& cameras);

}  // namespace radiata::client
