// Options of global light on isosurfaces.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "radiata/v1/scene.pb.h"

namespace radiata::client {

struct IlluminationOptions {
    std::string payload;  ///< empty: surfaces are lit like glyphs
    std::string method;   ///< lattice or path-tracing; empty: not given
    std::string storage, interpolation, resolution;
    std::optional<std::uint32_t> bounces;
    std::vector<std::uint32_t> orders;
    bool on_own_level_sets = false, full = false, random_paths = false;
    std::string environment;  ///< id of an environment map
    std::optional<float> environment_scale;
    std::optional<float> relative_error;
    std::optional<std::uint32_t> samples_max;
    std::optional<float> budget_mib;
    std::vector<double> sky, sky_gradient, sky_up, rotation;
    std::vector<std::vector<double>> suns;   ///< X,Y,Z,DEGREES,R,G,B
    std::vector<std::vector<double>> lamps;  ///< X,Y,Z,RADIUS,R,G,B
    bool vicinity = false;
};

void addIlluminationOptions(CLI::App& app, IlluminationOptions& options);

/// \throws ClientError(kUsage) for settings without --global-light
void setIllumination(v1::Light& light, const IlluminationOptions& options);

/// One line: how far the light of a frame is. \param light  as it was asked for
std::string describe(const v1::IlluminationProgress& progress, const v1::Illumination& light);

}  // namespace radiata::client
