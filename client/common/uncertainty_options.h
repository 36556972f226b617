// The options that show how uncertain glyphs are.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "radiata/v1/scene.pb.h"

namespace radiata::client {

struct UncertaintyOptions {
    std::string glyphs;      ///< catalogue id of second glyphs, or nothing
    std::string deviations;  ///< catalogue id of standard deviations, or nothing
    std::optional<float> deviation_count;
    std::optional<float> extinction_per_mm;
    std::vector<double> emission;  ///< three numbers or none
};

void addUncertaintyOptions(CLI::App& app, UncertaintyOptions& options);

/// Leaves the layer as it is if no uncertainty is asked for. \throws ClientError(kUsage) if options contradict each other
void setUncertainty(v1::GlyphLayer& glyphs, const UncertaintyOptions& options);

}  // namespace radiata::client
