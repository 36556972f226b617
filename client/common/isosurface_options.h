// Options for layers of isosurfaces and the methods that find them.
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "radiata/v1/frame.pb.h"

namespace radiata::client {

struct IsosurfaceOptions {
    std::vector<std::string> layers;  ///< as the help of --isosurface says
    v1::IsosurfaceSettings settings;
};

void addIsosurfaceOptions(CLI::App& app, IsosurfaceOptions& options);

/// Adds the layers to the scene and the settings to the quality. \throws ClientError(kUsage) naming what cannot be understood
void setIsosurfaces(v1::FrameRequest& request, const IsosurfaceOptions& options);

}  // namespace radiata::client
