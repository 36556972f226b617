// Flags of radiata-server.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gpu/device.h"
#include "io/sh_options.h"
#include "io/tensor_options.h"
#include "io/vtk_lines.h"
#include "service/server.h"
#include "session/conductor.h"

namespace radiata::tools {

struct ProgramOptions {
    service::ServerOptions server;
    session::Settings settings;
    gpu::DeviceOptions device;
    io::ShOptions sh;
    std::vector<std::filesystem::path> data;
    std::vector<std::pair<io::TensorOptions, std::filesystem::path>> tensors;
    std::filesystem::path tract_cache, lattice_folder;
    io::VtkSpace vtk_space = io::VtkSpace::kAuto;          ///< of .vtk and .vtp tractograms
    model::Traversal traversal = model::Traversal::kAuto;  ///< for requests that leave it open
    std::optional<int> stub_render_ms;
    bool list_devices = false;
    bool test_pipelines = false;
    std::string log_level = "info";
};

/// \return the options, or nothing if the program is to end with `exit_code` (--help, or a wrong flag that was named on stderr)
std::optional<ProgramOptions> parseOptions(int argc, char** argv, int& exit_code);

}  // namespace radiata::tools
