// Global light: sky, suns and lights, and how texels keep it.
#include <algorithm>

#include "service/convert.h"
#include "service/convert_checks.h"

namespace radiata::service {
namespace {

glm::dvec3 vectorOf(const v1::Vec3& v) { return {v.x(), v.y(), v.z()}; }
glm::vec3 colourOf(const v1::Vec3& v) { return glm::vec3(vectorOf(v)); }

v1::Vec3 colour(const glm::vec3& v) { return toProto(glm::dvec3(v)); }

template <typename Model, typename Message>
Model choice(Message message, Model otherwise) {
    // Words of the message are those of the model after its first, which is "unspecified".
    return message == 0 ? otherwise : static_cast<Model>(static_cast<int>(message) - 1);
}
template <typename Message, typename Model>
Message word(Model model) {
    return static_cast<Message>(static_cast<int>(model) + 1);
}

void fromLights(const v1::Illumination& message, model::Illumination& light) {
    if (message.sky().has_radiance()) light.sky.radiance = colourOf(message.sky().radiance());
    if (message.sky().has_gradient()) light.sky.gradient = colourOf(message.sky().gradient());
    if (message.sky().has_up()) light.sky.up = vectorOf(message.sky().up());
    if (message.has_environment()) {
        light.environment = model::EnvironmentLight{message.environment().id(), 1};
        if (message.environment().has_scale()) light.environment->scale = message.environment().scale();
    }
    for (const v1::SunDisc& sun : message.suns()) {
        model::SunDisc& added = light.suns.emplace_back();
        if (sun.has_direction()) added.direction = vectorOf(sun.direction());
        if (sun.has_angular_radius_deg()) added.angular_radius_deg = sun.angular_radius_deg();
        if (sun.has_irradiance()) added.irradiance = colourOf(sun.irradiance());
    }
    for (const v1::SphereLight& lamp : message.lights()) {
        model::SphereLight& added = light.lights.emplace_back();
        added.position_mm = vectorOf(lamp.position_mm());
        added.radius_mm = lamp.radius_mm();
        if (lamp.has_intensity()) added.intensity = colourOf(lamp.intensity());
    }
}

}  // namespace

model::Illumination fromProto(const v1::Illumination& message, const std::string& where) {
    checkEnum(message.method(), v1::IlluminationMethod_IsValid, v1::IlluminationMethod_MAX, where + ".method");
    checkEnum(message.payload(), v1::TexelPayload_IsValid, v1::TexelPayload_MAX, where + ".payload");
    checkEnum(message.storage(), v1::TexelStorage_IsValid, v1::TexelStorage_MAX, where + ".storage");
    checkEnum(message.interpolation(), v1::TexelInterpolation_IsValid, v1::TexelInterpolation_MAX, where + ".interpolation");
    checkEnum(message.sampling(), v1::TexelSampling_IsValid, v1::TexelSampling_MAX, where + ".sampling");
    checkEnum(message.resolution(), v1::LatticeResolution_IsValid, v1::LatticeResolution_MAX, where + ".resolution");
    model::Illumination light;
    light.method = choice(message.method(), light.method);
    light.payload = choice(message.payload(), light.payload);
    light.storage = choice(message.storage(), light.storage);
    light.interpolation = choice(message.interpolation(), light.interpolation);
    light.resolution = choice(message.resolution(), light.resolution);
    light.sampling = choice(message.sampling(), light.sampling);
    light.full = message.full();
    light.project = !light.full;
    if (message.has_bounces()) light.bounces = toInt(message.bounces(), where + ".bounces");
    if (message.orders_size() > static_cast<int>(light.orders.size())) {
        refuse(where + ".orders has " + std::to_string(message.orders_size()) +
               " numbers; light bounces 0 to 4 times, so at most 5");
    }
    for (int k = 0; k < static_cast<int>(light.orders.size()) && message.orders_size() > 0; ++k) {
        light.orders[static_cast<std::size_t>(k)] =
            toInt(message.orders(std::min(k, message.orders_size() - 1)), where + ".orders");
    }
    if (message.has_project()) light.project = message.project();
    if (message.has_relative_error()) light.relative_error = message.relative_error();
    if (message.has_samples_max()) light.samples_max = toInt(message.samples_max(), where + ".samples_max");
    if (message.has_budget_mib()) light.budget_mib = message.budget_mib();
    if (message.rotation_size() != 0 && message.rotation_size() != 4) {
        refuse(where + ".rotation has " + std::to_string(message.rotation_size()) + " numbers; a quaternion has 4: w, x, y, z");
    }
    for (int i = 0; i < message.rotation_size(); ++i) light.rotation[static_cast<std::size_t>(i)] = message.rotation(i);
    fromLights(message, light);
    return light;
}

v1::Illumination toProto(const model::Illumination& light) {
    v1::Illumination message;
    message.set_method(word<v1::IlluminationMethod>(light.method));
    message.set_payload(word<v1::TexelPayload>(light.payload));
    message.set_storage(word<v1::TexelStorage>(light.storage));
    message.set_interpolation(word<v1::TexelInterpolation>(light.interpolation));
    message.set_resolution(word<v1::LatticeResolution>(light.resolution));
    message.set_sampling(word<v1::TexelSampling>(light.sampling));
    message.set_full(light.full);
    message.set_bounces(static_cast<std::uint32_t>(light.bounces));
    for (const int order : light.orders) message.add_orders(static_cast<std::uint32_t>(order));
    message.set_project(light.project);
    message.set_relative_error(light.relative_error);
    message.set_samples_max(static_cast<std::uint32_t>(light.samples_max));
    message.set_budget_mib(light.budget_mib);
    *message.mutable_sky()->mutable_radiance() = colour(light.sky.radiance);
    *message.mutable_sky()->mutable_gradient() = colour(light.sky.gradient);
    *message.mutable_sky()->mutable_up() = toProto(light.sky.up);
    if (light.environment) {
        message.mutable_environment()->set_id(light.environment->id);
        message.mutable_environment()->set_scale(light.environment->scale);
    }
    for (const model::SunDisc& sun : light.suns) {
        v1::SunDisc* added = message.add_suns();
        *added->mutable_direction() = toProto(sun.direction);
        added->set_angular_radius_deg(sun.angular_radius_deg);
        *added->mutable_irradiance() = colour(sun.irradiance);
    }
    for (const model::SphereLight& lamp : light.lights) {
        v1::SphereLight* added = message.add_lights();
        *added->mutable_position_mm() = toProto(lamp.position_mm);
        added->set_radius_mm(lamp.radius_mm);
        *added->mutable_intensity() = colour(lamp.intensity);
    }
    for (const double number : light.rotation) message.add_rotation(number);
    return message;
}

v1::IlluminationProgress toProto(const model::IlluminationInfo& info) {
    v1::IlluminationProgress message;
    message.set_texels(info.texels);
    message.set_texels_needed(info.texels_needed);
    message.set_texels_done(info.texels_done);
    message.set_texels_out_of_samples(info.texels_out_of_samples);
    message.set_bricks_left_out(info.bricks_left_out);
    message.set_samples(info.samples);
    message.set_mean_error(info.mean_error);
    message.set_p95_error(info.p95_error);
    message.set_seconds(info.seconds);
    message.set_bytes(info.bytes);
    message.set_projected(info.projected);
    message.set_payload_bytes(info.payload_bytes);
    message.set_texels_read(info.texels_read);
    message.set_saved(info.saved);
    return message;
}

}  // namespace radiata::service
