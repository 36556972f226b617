// The options that describe the light of a picture: direction, shadows, ambient occlusion.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "radiata/v1/scene.pb.h"

#include "common/illumination_options.h"

namespace radiata::client {

/// Vectors hold three numbers, or none where the option was not given; absent choices are left to the server.
struct LightOptions {
    IlluminationOptions illumination;
    std::string shading;  ///< of isosurfaces: scene, lambert, lambert-fog, phong, vicinity, full; empty: not given
    std::vector<double> direction_camera;
    std::vector<double> direction_world;
    std::optional<float> irradiance;
    std::optional<float> ambient;
    std::string shadow;  ///< none, hard or soft; empty: not given
    std::optional<float> angular_radius_deg;
    std::optional<std::uint32_t> shadow_rays;
    std::optional<std::uint32_t> occlusion_rays;  ///< ambient occlusion is on if given
    std::optional<float> occlusion_radius_mm;
};

void addLightOptions(CLI::App& app, LightOptions& options);

/// \throws ClientError(kUsage) if options contradict each other
void setLight(v1::Light& light, const LightOptions& options);

/// The local part of --shading, for the isosurfaces of a scene that have none of their own.
void setShading(v1::Scene& scene, const LightOptions& options);

}  // namespace radiata::client
