#include "model/illumination.h"

#include <cmath>
#include <cstdio>
#include <string>

#include "base/error.h"

namespace radiata::model {
namespace {

constexpr float kRadianceMax = 1000;
constexpr float kIntensityMax = 1e9F;
constexpr float kScaleMax = 1e6F;
constexpr std::size_t kLightsMax = 16;

[[noreturn]] void refuse(const std::string& message) { throw Error(Code::kInvalidArgument, message); }

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.9g", value);
    return text;
}

void checkRange(double value, double low, double high, const std::string& field) {
    if (value >= low && value <= high) return;
    refuse(field + " is " + number(value) + "; it must be " + number(low) + " to " + number(high));
}

void checkColour(const glm::vec3& colour, double high, const std::string& field) {
    for (int c = 0; c < 3; ++c) checkRange(colour[c], 0, high, field + "." + "xyz"[c]);
}

void checkDirection(const glm::dvec3& d, const std::string& field) {
    const double length = glm::length(d);
    if (!(length > 0 && std::isfinite(length))) refuse(field + " has length " + std::to_string(length) + "; it must not be 0");
}

void checkLights(const Illumination& light, const std::string& where) {
    checkColour(light.sky.radiance, kRadianceMax, where + ".sky.radiance");
    for (int c = 0; c < 3; ++c) {
        const std::string field = where + ".sky.gradient." + "xyz"[c];
        checkRange(light.sky.gradient[c], -light.sky.radiance[c], light.sky.radiance[c],
                   field + " (a sky is nowhere negative)");
    }
    checkDirection(light.sky.up, where + ".sky.up");
    if (light.environment) {
        if (light.environment->id.empty())
            refuse(where + ".environment.id is empty; the catalogue lists the names of environment maps");
        checkRange(light.environment->scale, 0, kScaleMax, where + ".environment.scale");
    }
    if (light.suns.size() > kLightsMax || light.lights.size() > kLightsMax) {
        refuse(where + " has " + std::to_string(light.suns.size()) + " suns and " + std::to_string(light.lights.size()) +
               " lights; at most 16 of each are used");
    }
    for (std::size_t i = 0; i < light.suns.size(); ++i) {
        const std::string sun = where + ".suns[" + std::to_string(i) + "]";
        checkDirection(light.suns[i].direction, sun + ".direction");
        checkRange(light.suns[i].angular_radius_deg, 0.01, 90, sun + ".angular_radius_deg");
        checkColour(light.suns[i].irradiance, kRadianceMax, sun + ".irradiance");
    }
    for (std::size_t i = 0; i < light.lights.size(); ++i) {
        const std::string lamp = where + ".lights[" + std::to_string(i) + "]";
        for (int c = 0; c < 3; ++c) checkRange(light.lights[i].position_mm[c], -1e6, 1e6, lamp + ".position_mm." + "xyz"[c]);
        checkRange(light.lights[i].radius_mm, 0, 1e5, lamp + ".radius_mm");
        checkColour(light.lights[i].intensity, kIntensityMax, lamp + ".intensity");
    }
    if (!light.lights.empty() && light.payload == TexelPayload::kTransfer) {
        refuse(where + ".lights stand in the scene; texels with transfer know distant light only: choose irradiance, or suns");
    }
    checkDirection({light.rotation[1], light.rotation[2], std::hypot(light.rotation[0], light.rotation[3])},
                   where + ".rotation");
}

}  // namespace

void validate(const Illumination& light, const std::string& where) {
    checkRange(light.bounces, 0, kBouncesMax, where + ".bounces");
    for (const int order : light.orders) checkRange(order, 1, 5, where + ".orders");
    checkRange(light.relative_error, 0.001, 1, where + ".relative_error");
    const int samples = light.samples_max;
    if (samples < 4 || samples > 16384 || (samples & (samples - 1)) != 0) {
        refuse(where + ".samples_max is " + std::to_string(samples) + "; it must be a power of two from 4 to 16384");
    }
    checkRange(light.budget_mib, 0.001, 1048576, where + ".budget_mib");
    if (light.storage == TexelStorage::kRgb8 && light.payload == TexelPayload::kTransfer) {
        refuse(where + ".storage is RGB8, which holds irradiance; transfer needs float16 or float32");
    }
    if (light.full && light.project) {
        refuse(where +
               ".full asks for all texels, which are lit on their own level sets; .project would light them on one surface");
    }
    checkLights(light, where);
}

}  // namespace radiata::model
