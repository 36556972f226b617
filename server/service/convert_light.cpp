// Lights: direction, shadows, ambient occlusion.
#include "service/convert.h"
#include "service/convert_checks.h"

namespace radiata::service {
namespace {

glm::dvec3 vectorOf(const v1::Vec3& v) { return {v.x(), v.y(), v.z()}; }

}  // namespace

model::Light fromProto(const v1::Light& light, const std::string& where) {
    model::Light result;
    if (light.has_direction_camera() && light.has_direction_world()) {
        refuse(where + " has both direction_camera and direction_world; a light hangs on the camera or stands in the world");
    }
    if (light.has_direction_camera()) result.direction_camera = vectorOf(light.direction_camera());
    if (light.has_direction_world()) result.direction_world = vectorOf(light.direction_world());
    if (light.has_irradiance()) result.irradiance = light.irradiance();
    if (light.has_ambient()) result.ambient = light.ambient();
    checkEnum(light.shadow(), v1::Shadow_IsValid, v1::Shadow_MAX, where + ".shadow");
    if (light.shadow() == v1::SHADOW_HARD) result.shadow = model::Shadow::kHard;
    if (light.shadow() == v1::SHADOW_SOFT) result.shadow = model::Shadow::kSoft;
    if (light.has_angular_radius_deg()) result.angular_radius_deg = light.angular_radius_deg();
    if (light.has_shadow_rays()) result.shadow_rays = toInt(light.shadow_rays(), where + ".shadow_rays");
    if (light.has_ambient_occlusion()) {
        const v1::AmbientOcclusion& occlusion = light.ambient_occlusion();
        result.ambient_occlusion = model::AmbientOcclusion{};
        if (occlusion.has_rays()) result.ambient_occlusion->rays = toInt(occlusion.rays(), where + ".ambient_occlusion.rays");
        if (occlusion.has_radius_mm()) result.ambient_occlusion->radius_mm = occlusion.radius_mm();
    }
    if (light.has_illumination()) result.illumination = fromProto(light.illumination(), where + ".illumination");
    return result;
}

v1::Light toProto(const model::Light& light) {
    v1::Light message;
    if (light.direction_world) {
        *message.mutable_direction_world() = toProto(*light.direction_world);
    } else {
        *message.mutable_direction_camera() = toProto(light.direction_camera);
    }
    message.set_irradiance(light.irradiance);
    message.set_ambient(light.ambient);
    switch (light.shadow) {
        case model::Shadow::kNone:
            message.set_shadow(v1::SHADOW_NONE);
            break;
        case model::Shadow::kHard:
            message.set_shadow(v1::SHADOW_HARD);
            break;
        case model::Shadow::kSoft:
            message.set_shadow(v1::SHADOW_SOFT);
            break;
    }
    message.set_angular_radius_deg(light.angular_radius_deg);
    message.set_shadow_rays(static_cast<std::uint32_t>(light.shadow_rays));
    if (light.ambient_occlusion) {
        message.mutable_ambient_occlusion()->set_rays(static_cast<std::uint32_t>(light.ambient_occlusion->rays));
        if (light.ambient_occlusion->radius_mm) {
            message.mutable_ambient_occlusion()->set_radius_mm(*light.ambient_occlusion->radius_mm);
        }
    }
    if (light.illumination) *message.mutable_illumination() = toProto(*light.illumination);
    return message;
}

}  // namespace radiata::service
