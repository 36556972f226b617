// Options for layers of fibres.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "radiata/v1/quality.pb.h"
#include "radiata/v1/scene.pb.h"

namespace radiata::client {

struct FibreOptions {
    std::string colour;  ///< empty: by direction
    std::string column;
    std::optional<std::uint32_t> line_width;
    std::optional<float> tube_radius_mm;
    std::vector<double> slab;  ///< point and normal, world, and thickness, mm
    std::vector<std::vector<double>> cuts;  ///< point and normal each
    std::vector<std::string> groups, select_groups;
    std::vector<std::uint32_t> fibres, select_fibres;
    std::vector<float> length;  ///< mm: low, high
    bool hide_unselected = false;
    std::string pipeline, culling;
};

void addFibreOptions(CLI::App& app, FibreOptions& options);
/// Whether any of them was given.
bool anyFibreOption(const FibreOptions& options);
/// Everything but the dataset, range and map of colours. \throws ClientError(kUsage)
void setFibres(v1::TractogramLayer& layer, const FibreOptions& options);
void setFibreQuality(v1::Quality& quality, const FibreOptions& options);

}  // namespace radiata::client
