#include "common/camera_json.h"

#include <algorithm>
#include <fstream>
#include <initializer_list>
#include <iterator>

#include "common/client_error.h"

namespace radiata::client {
namespace {

using nlohmann::json;

constexpr std::size_t kCamerasMax = 100'000;
constexpr std::size_t kFileBytesMax = 64 << 20;

[[noreturn]] void refuse(const std::string& message) { throw ClientError(ExitCode::kUsage, message); }

void checkKeys(const json& object, std::initializer_list<const char*> known, const std::string& where) {
    if (!object.is_object()) refuse(where + " is not a JSON object");
    for (const auto& [key, value] : object.items()) {
        if (std::find(known.begin(), known.end(), key) == known.end()) {
            std::string names;
            for (const char* name : known) names += std::string(names.empty() ? "" : ", ") + name;
            refuse(where + " has the field '" + key + "', which is not known; the fields are " + names);
        }
    }
}

double number(const json& object, const char* key, const std::string& where) {
    const json& value = object.at(key);
    if (!value.is_number()) refuse(where + ": " + key + " is not a number");
    return value.get<double>();
}

void readVector(const json& object, const char* key, v1::Vec3& vector, const std::string& where) {
    if (!object.contains(key)) refuse(where + ": " + key + " is missing");
    const json& value = object.at(key);
    const auto isNumber = [](const json& element) { return element.is_number(); };
    if (!value.is_array() || value.size() != 3 || !std::all_of(value.begin(), value.end(), isNumber)) {
        refuse(where + ": " + key + " is not a list of three numbers");
    }
    vector.set_x(value[0].get<double>());
    vector.set_y(value[1].get<double>());
    vector.set_z(value[2].get<double>());
}

json readJsonFile(const std::string& file) {
    std::ifstream stream(file, std::ios::binary | std::ios::ate);
    if (!stream) refuse(file + " cannot be opened");
    const std::streamoff size = stream.tellg();
    if (size < 0 || static_cast<std::size_t>(size) > kFileBytesMax) {
        refuse(file + " is no camera file: it must be a plain file of at most 64 MiB");
    }
    stream.seekg(0);
    const std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
    try {
        return json::parse(text);
    } catch (const json::exception& error) {
        refuse(file + " is not JSON: " + error.what());
    }
}

json vectorToJson(const v1::Vec3& vector) { return {vector.x(), vector.y(), vector.z()}; }

}  // namespace

v1::Camera cameraFromJson(const json& object, const std::string& where) {
    checkKeys(object, {"eye_mm", "target_mm", "up", "field_of_view_deg", "height_mm", "clip"}, where);
    v1::Camera camera;
    readVector(object, "eye_mm", *camera.mutable_eye_mm(), where);
    readVector(object, "target_mm", *camera.mutable_target_mm(), where);
    readVector(object, "up", *camera.mutable_up(), where);
    if (object.contains("field_of_view_deg") == object.contains("height_mm")) {
        refuse(where + " must have either field_of_view_deg (perspective) or height_mm (orthographic)");
    }
    if (object.contains("field_of_view_deg")) {
        camera.set_field_of_view_deg(number(object, "field_of_view_deg", where));
    } else {
        camera.set_height_mm(number(object, "height_mm", where));
    }
    if (object.contains("clip")) {
        const json& clip = object.at("clip");
        checkKeys(clip, {"nearest_mm", "farthest_mm"}, where + ": clip");
        if (clip.size() != 2) refuse(where + ": clip must have nearest_mm and farthest_mm");
        camera.mutable_clip()->set_nearest_mm(number(clip, "nearest_mm", where + ": clip"));
        camera.mutable_clip()->set_farthest_mm(number(clip, "farthest_mm", where + ": clip"));
    }
    return camera;
}

json cameraToJson(const v1::Camera& camera) {
    json object = {{"eye_mm", vectorToJson(camera.eye_mm())},
                   {"target_mm", vectorToJson(camera.target_mm())},
                   {"up", vectorToJson(camera.up())}};
    if (camera.lens_case() == v1::Camera::kFieldOfViewDeg) object["field_of_view_deg"] = camera.field_of_view_deg();
    if (camera.lens_case() == v1::Camera::kHeightMm) object["height_mm"] = camera.height_mm();
    if (camera.has_clip()) {
        object["clip"] = {{"nearest_mm", camera.clip().nearest_mm()}, {"farthest_mm", camera.clip().farthest_mm()}};
    }
    return object;
}

v1::Camera cameraFromOption(const std::string& text) {
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    if (first == std::string::npos || text[first] != '{') return cameraFromJson(readJsonFile(text), text);
    json object;
    try {
        object = json::parse(text);
    } catch (const json::exception& error) {
        refuse(std::string("--camera is not JSON: ") + error.what());
    }
    return cameraFromJson(object, "--camera");
}

std::vector<v1::Camera> readCameraPath(const std::string& file) {
    const json document = readJsonFile(file);
    if (document.is_object()) checkKeys(document, {"cameras"}, file);
    const bool wrapped = document.is_object() && document.contains("cameras");
    const json& list = wrapped ? document.at("cameras") : document;
    if (!list.is_array() || list.empty() || list.size() > kCamerasMax) {
        refuse(file + " is no camera path: it must be a list of 1 to " + std::to_string(kCamerasMax) + " cameras");
    }
    std::vector<v1::Camera> cameras;
    cameras.reserve(list.size());
    for (std::size_t i = 0; i < list.size(); ++i) {
        cameras.push_back(cameraFromJson(list[i], file + ": camera " + std::to_string(i)));
    }
    return cameras;
}

json cameraPathToJson(const std::vector<v1::Camera>& cameras) {
    json list = json::array();
    for (const v1::Camera& camera : cameras) list.push_back(cameraToJson(camera));
    return list;
}

}  // namespace radiata::client
