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
    std::vector<std::string> datasets;  ///< a layer of fibres each, all of which look as the rest says
    std::string colour;                 ///< empty: by direction
    std::string column;                 ///< per fibre or, as NAME or NAME:COMPONENT, per point
    std::string near;                   ///< region of colours by distance
    std::string map;                    ///< word of v1::ColourMap
    std::vector<float> range;           ///< two numbers
    std::vector<double> uniform;
    std::optional<std::uint32_t> line_width;
    std::optional<float> tube_radius_mm, occlusion_px, halo_px;
    std::vector<double> slab;               ///< point and normal, world, and thickness, mm
    std::vector<std::vector<double>> cuts;  ///< point and normal each
    std::vector<std::string> groups, select_groups;
    std::vector<std::uint32_t> fibres, select_fibres;
    std::vector<float> length;  ///< mm: low, high
    bool hide_unselected = false;
    bool exact_width = false;
    std::string show, select;                  ///< selections
    std::vector<std::string> inside, outside;  ///< regions
    bool by_depths = false;
    std::vector<std::string> criteria;  ///< COLUMN,LOW,HIGH
    std::string pipeline, culling;
    std::optional<float> opacity;
    std::optional<float> detail_px;
    std::string frozen;  ///< camera: file or JSON
};

void addFibreOptions(CLI::App& app, FibreOptions& options);
/// A layer of fibres for each tractogram that is named. \throws ClientError(kUsage) for options that contradict each other
void addFibres(v1::Scene& scene, const FibreOptions& options);
void setFibreQuality(v1::Quality& quality, const FibreOptions& options);

}  // namespace radiata::client
