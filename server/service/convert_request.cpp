// Cameras, and the requests that carry them.
#include "service/convert.h"
#include "service/convert_checks.h"

namespace radiata::service {
namespace {

glm::dvec3 required(bool present, const v1::Vec3& v, const std::string& where) {
    if (!present) refuse(where + " is missing");
    return {v.x(), v.y(), v.z()};
}

}  // namespace

model::Camera fromProto(const v1::Camera& camera, const std::string& where) {
    model::Camera result;
    result.eye_mm = required(camera.has_eye_mm(), camera.eye_mm(), where + ".eye_mm");
    result.target_mm = required(camera.has_target_mm(), camera.target_mm(), where + ".target_mm");
    result.up = required(camera.has_up(), camera.up(), where + ".up");
    switch (camera.lens_case()) {
        case v1::Camera::kFieldOfViewDeg:
            result.perspective = true;
            result.field_of_view_deg = camera.field_of_view_deg();
            break;
        case v1::Camera::kHeightMm:
            result.height_mm = camera.height_mm();
            break;
        case v1::Camera::LENS_NOT_SET:
            refuse(where + ": field_of_view_deg (perspective) and height_mm (orthographic) are both missing; give one");
    }
    if (camera.has_clip()) result.clip = model::Clip{camera.clip().nearest_mm(), camera.clip().farthest_mm()};
    return result;
}

v1::Camera toProto(const model::Camera& camera) {
    v1::Camera message;
    *message.mutable_eye_mm() = toProto(camera.eye_mm);
    *message.mutable_target_mm() = toProto(camera.target_mm);
    *message.mutable_up() = toProto(camera.up);
    if (camera.perspective) {
        message.set_field_of_view_deg(camera.field_of_view_deg);
    } else {
        message.set_height_mm(camera.height_mm);
    }
    if (camera.clip) {
        message.mutable_clip()->set_nearest_mm(camera.clip->nearest_mm);
        message.mutable_clip()->set_farthest_mm(camera.clip->farthest_mm);
    }
    return message;
}

model::FrameRequest fromProto(const v1::FrameRequest& request, const std::string& where) {
    if (!request.has_scene()) refuse(where + ".scene is missing");
    if (!request.has_camera()) refuse(where + ".camera is missing; CatalogService.FitCamera proposes one");
    model::FrameRequest result;
    result.scene = fromProto(request.scene(), where + ".scene");
    result.camera = fromProto(request.camera(), where + ".camera");
    result.quality = fromProto(request.quality(), where + ".quality");
    result.width = toInt(request.width(), where + ".width");
    result.height = toInt(request.height(), where + ".height");
    return result;
}

v1::FrameRequest toProto(const model::FrameRequest& request) {
    v1::FrameRequest message;
    *message.mutable_scene() = toProto(request.scene);
    *message.mutable_camera() = toProto(request.camera);
    *message.mutable_quality() = toProto(request.quality);
    message.set_width(static_cast<std::uint32_t>(request.width));
    message.set_height(static_cast<std::uint32_t>(request.height));
    return message;
}

session::Change fromProto(const v1::UpdateRequest& request) {
    session::Change change;
    change.acknowledged_sequence = request.acknowledged_sequence();
    change.camera_sequence = request.camera_sequence();
    change.client_time_ms = request.client_time_ms();
    if (request.has_camera()) change.camera = fromProto(request.camera(), "camera");
    if (request.has_scene()) change.scene = fromProto(request.scene(), "scene");
    if (request.has_quality()) change.quality = fromProto(request.quality(), "quality");
    if ((request.width() == 0) != (request.height() == 0)) {
        refuse("width is " + std::to_string(request.width()) + " and height is " + std::to_string(request.height()) +
               "; give both or none");
    }
    if (request.width() != 0) change.size = session::Size{toInt(request.width(), "width"), toInt(request.height(), "height")};
    return change;
}

model::Outputs outputsFromProto(const v1::RenderRequest& request) {
    model::Outputs outputs;
    for (int i = 0; i < request.outputs_size(); ++i) {
        const std::string where = "outputs[" + std::to_string(i) + "]";
        bool* wanted = nullptr;
        switch (request.outputs(i)) {
            case v1::OUTPUT_DEPTH:
                wanted = &outputs.depth;
                break;
            case v1::OUTPUT_ID:
                wanted = &outputs.id;
                break;
            case v1::OUTPUT_POSITION:
                wanted = &outputs.position;
                break;
            case v1::OUTPUT_NORMAL:
                wanted = &outputs.normal;
                break;
            case v1::OUTPUT_STEPS:
                wanted = &outputs.steps;
                break;
            default:
                refuse(where + " is " + std::to_string(static_cast<int>(request.outputs(i))) + "; 1 (depth) to " +
                       std::to_string(static_cast<int>(v1::Output_MAX)) + " (steps) are defined");
        }
        if (*wanted)
            refuse(where + " is " + v1::Output_Name(request.outputs(i)) + " for the second time; name each output once");
        *wanted = true;
    }
    return outputs;
}

session::ImageFormat formatFromProto(v1::ImageFormat format, const std::string& where) {
    checkEnum(format, v1::ImageFormat_IsValid, v1::ImageFormat_MAX, where);
    return format == v1::IMAGE_FORMAT_JPEG ? session::ImageFormat::kJpeg : session::ImageFormat::kPng;
}

}  // namespace radiata::service
