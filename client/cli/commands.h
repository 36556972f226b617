// The commands of the program `radiata`. Each adds itself to the program and leaves a function to run if it was chosen.
#pragma once

#include <CLI/CLI.hpp>

#include "common/connection.h"

namespace radiata::client {

/// list, info [DATASET] and limits: what there is and what may be asked for.
void addCatalogCommands(CLI::App& app, const ConnectionOptions& connection);
/// render: one picture with any outputs.
void addRenderCommand(CLI::App& app, const ConnectionOptions& connection);
/// orbit: numbered pictures of a turn, or of a camera path.
void addOrbitCommand(CLI::App& app, const ConnectionOptions& connection);

/// pick: what lies under a pixel.
void addPickCommand(CLI::App& app, const ConnectionOptions& connection);

/// lasso: which fibres lie in an outline on the picture.
void addLassoCommand(CLI::App& app, const ConnectionOptions& connection);

/// select: counts, names or exports fibres of a tractogram.
void addSelectCommand(CLI::App& app, const ConnectionOptions& connection);

}  // namespace radiata::client
