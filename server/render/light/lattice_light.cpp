#include "render/light/lattice_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include <glm/gtx/component_wise.hpp>

#include "base/error.h"
#include "build/bright_pixels.h"
#include "build/light_harmonics.h"

namespace radiata::render {
namespace {

constexpr double kPi = std::numbers::pi;

float luminance(const glm::dvec3& c) { return static_cast<float>(0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z); }

template <typename T>
gpu::Buffer uploaded(gpu::Device& device, const std::vector<T>& values, const char* name) {
    gpu::Buffer buffer(device, std::max<std::size_t>(values.size() * sizeof(T), 16), gpu::Memory::kDevice, name);
    if (!values.empty()) gpu::upload(device, buffer, 0, std::as_bytes(std::span(values)));
    return buffer;
}

/// Radiance from everywhere that has the map's power.
glm::dvec3 meanOf(const model::EnvironmentMap& map) {
    glm::dvec3 sum(0);
    if (!map.harmonics[0].empty()) {
        for (std::size_t c = 0; c < 3; ++c) sum[static_cast<int>(c)] = map.harmonics[c][0] / std::sqrt(4 * kPi);
        return sum;
    }
    for (int y = 0; y < map.height; ++y) {
        const double share = (std::cos(kPi * y / map.height) - std::cos(kPi * (y + 1) / map.height)) / 2 / map.width;
        for (int x = 0; x < map.width; ++x) {
            sum += share * glm::dvec3(map.pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width) +
                                                 static_cast<std::size_t>(x)]);
        }
    }
    return sum;
}

}  // namespace

void LatticeLightBuffers::addMap(gpu::Device& device, const model::EnvironmentMap& map, LatticeLightBuffers* former) {
    map_source_ = &map;
    if (former != nullptr && former->map_source_ == &map && former->map_) {
        map_ = std::move(former->map_);
        bright_ = std::move(former->bright_);
        bright_weight_ = former->bright_weight_;
        params_.bright_count = former->params_.bright_count;
        params_.map_cap = former->params_.map_cap;
    } else {
        const BrightPixels bright = brightPixels(map);
        map_ = uploaded(device, map.pixels, "environment map");
        bright_ = uploaded(device, bright.table, "bright pixels");
        bright_weight_ = bright.weight;
        params_.bright_count = static_cast<std::uint32_t>(bright.table.size());
        params_.map_cap = bright.cap;
    }
    params_.map = map_.address();
    params_.bright = bright_.address();
    params_.map_width = static_cast<std::uint32_t>(map.width);
    params_.map_height = static_cast<std::uint32_t>(map.height);
}

LatticeLightBuffers::LatticeLightBuffers(gpu::Device& device, const model::Illumination& light,
                                         const model::EnvironmentMap* map, const store::VolumeDataset& volume,
                                         LatticeLightBuffers* former) {
    const glm::dmat3 turn = lightRotation(light), back = glm::transpose(turn);
    glm::dvec3 open = glm::dvec3(light.sky.radiance) * kPi, all = open + kPi * glm::abs(glm::dvec3(light.sky.gradient));
    params_.radiance = light.sky.radiance;
    params_.gradient = light.sky.gradient;
    params_.up = glm::vec3(turn * glm::normalize(light.sky.up));
    if (light.environment) {
        if (map == nullptr) throw Error(Code::kInternal, "environment " + light.environment->id + " was not read");
        // Transfer meets the map's harmonics alone.
        if (light.payload == model::TexelPayload::kIrradiance) addMap(device, *map, former);
        params_.map_scale = light.environment->scale;
        params_.bright_weight = static_cast<float>(bright_weight_ * light.environment->scale);
        open = kPi * light.environment->scale * meanOf(*map);
        all = 4.0 * open;
    }
    params_.map_x = glm::vec3(back[0]);
    params_.map_y = glm::vec3(back[1]);
    params_.map_z = glm::vec3(back[2]);
    std::vector<shader::SunParams> suns;
    for (const model::SunDisc& sun : light.suns) {
        suns.push_back({glm::vec3(turn * glm::normalize(sun.direction)),
                        static_cast<float>(std::cos(sun.angular_radius_deg * kPi / 180)), sun.irradiance, 0});
        open += glm::dvec3(sun.irradiance);
        all += glm::dvec3(sun.irradiance);
    }
    std::vector<shader::SphereLightParams> spheres;
    for (const model::SphereLight& sphere : light.lights) {
        spheres.push_back({glm::vec3(volume.worldToGrid(sphere.position_mm)), sphere.radius_mm, sphere.intensity, 0});
        // As if a hundred millimetres away: only a floor for relative errors.
        open += glm::dvec3(sphere.intensity) / 1e4;
        all += glm::dvec3(sphere.intensity) / 1e2;
    }
    suns_ = uploaded(device, suns, "suns");
    spheres_ = uploaded(device, spheres, "lights in the scene");
    params_.sun_count = static_cast<std::uint32_t>(suns.size());
    params_.sphere_count = static_cast<std::uint32_t>(spheres.size());
    params_.suns = suns_.address();
    params_.spheres = spheres_.address();
    if (light.payload == model::TexelPayload::kTransfer) {
        const auto harmonics = lightHarmonics(light, map, 5);
        std::vector<glm::vec3> values;
        for (std::size_t i = 0; i < harmonics[0].size(); ++i) {
            values.emplace_back(harmonics[0][i], harmonics[1][i], harmonics[2][i]);
        }
        harmonics_ = uploaded(device, values, "light harmonics");
        params_.harmonics = harmonics_.address();
    }
    open_irradiance_ = luminance(open);
    radiance_max_ = static_cast<float>(1.5 * glm::compMax(all / kPi));
}

}  // namespace radiata::render
