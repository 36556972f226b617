#include "common/fibre_options.h"

#include <charconv>
#include <cmath>

#include "common/camera_json.h"
#include "common/client_error.h"
#include "common/enum_words.h"
#include "common/table.h"

namespace radiata::client {
namespace {

void setVector(v1::Vec3& vector, double x, double y, double z) {
    vector.set_x(x);
    vector.set_y(y);
    vector.set_z(z);
}

void addCut(v1::TractogramLayer& layer, const double* point, const double* normal, double sign, double shift_mm) {
    const double length = std::hypot(normal[0], normal[1], normal[2]);
    const double along = length > 0 ? shift_mm / length : 0;
    v1::FibreCut& cut = *layer.add_cuts();
    setVector(*cut.mutable_point_mm(), point[0] + along * normal[0], point[1] + along * normal[1],
              point[2] + along * normal[2]);
    setVector(*cut.mutable_normal(), sign * normal[0], sign * normal[1], sign * normal[2]);
}

bool anyOption(const FibreOptions& options) {
    return !options.colour.empty() || !options.column.empty() || !options.map.empty() || !options.range.empty() ||
           !options.uniform.empty() || options.line_width || options.tube_radius_mm || options.occlusion_px ||
           options.halo_px || !options.slab.empty() || !options.cuts.empty() || !options.groups.empty() ||
           !options.fibres.empty() || !options.length.empty() || !options.select_groups.empty() ||
           !options.select_fibres.empty() || options.hide_unselected || options.exact_width || !options.near.empty() ||
           !options.show.empty() || !options.select.empty() || !options.inside.empty() || !options.outside.empty() ||
           !options.criteria.empty() || options.by_depths || options.opacity;
}

template <typename Message>
void setMap(Message& message, const FibreOptions& options) {
    if (!options.map.empty()) message.set_map(enumWords<v1::ColourMap>(v1::ColourMap_descriptor(), "").at(options.map));
    if (options.range.empty()) return;
    message.mutable_range()->set_low(options.range[0]);
    message.mutable_range()->set_high(options.range[1]);
}

/// NAME, or NAME:COMPONENT.
void setPointColumn(v1::FibrePointColour& colour, const FibreOptions& options) {
    const std::size_t colon = options.column.rfind(':');
    const std::string digits = colon == options.column.npos ? "" : options.column.substr(colon + 1);
    std::uint32_t component = 0;
    const auto [end, failure] = std::from_chars(digits.data(), digits.data() + digits.size(), component);
    const bool numbered = !digits.empty() && failure == std::errc() && end == digits.data() + digits.size();
    colour.set_name(numbered ? options.column.substr(0, colon) : options.column);
    colour.set_component(numbered ? component : 0);
    setMap(colour, options);
}

/// COLUMN,LOW,HIGH; the name may hold commas itself.
void addCriterion(v1::TractogramLayer& layer, const std::string& text) {
    const std::size_t second = text.rfind(','),
                      first = second == 0 || second == text.npos ? text.npos : text.rfind(',', second - 1);
    v1::FibreCriterion& criterion = *layer.add_criteria();
    float bounds[2] = {0, 0};
    bool good = first != text.npos && first > 0;
    for (int i = 0; good && i < 2; ++i) {
        const std::string word = i == 0 ? text.substr(first + 1, second - first - 1) : text.substr(second + 1);
        const auto [end, failure] = std::from_chars(word.data(), word.data() + word.size(), bounds[i]);
        good = failure == std::errc() && end == word.data() + word.size();
    }
    if (!good) {
        throw ClientError(ExitCode::kUsage, "--criterion is '" + text + "'; it must be COLUMN,LOW,HIGH, such as fa,0.3,inf");
    }
    criterion.set_column(text.substr(0, first));
    criterion.set_low(bounds[0]);
    criterion.set_high(bounds[1]);
}

void setColour(v1::FibreColour& colour, const FibreOptions& options) {
    const bool point = options.colour == "point", column = options.colour == "column" || point;
    const bool distance = options.colour == "distance", mapped = column || distance || options.colour == "length";
    if (distance == options.near.empty()) {
        throw ClientError(ExitCode::kUsage, distance ? "--fibre-colour distance needs --fibre-near REGION"
                                                     : "--fibre-near goes with --fibre-colour distance only");
    }
    if (column == options.column.empty()) {
        throw ClientError(ExitCode::kUsage, column ? "--fibre-colour column and point need --fibre-column NAME"
                                                   : "--fibre-column goes with --fibre-colour column or point only");
    }
    if (!mapped && !(options.map.empty() && options.range.empty())) {
        throw ClientError(ExitCode::kUsage,
                          "--fibre-map and --fibre-range go with --fibre-colour column, point, length or distance only");
    }
    const bool uniform = options.colour == "uniform" || (options.colour.empty() && !options.uniform.empty());
    if (!uniform && !options.uniform.empty()) {
        throw ClientError(ExitCode::kUsage, "--fibre-uniform goes with --fibre-colour uniform only");
    }
    const std::vector<double> rgb = options.uniform.empty() ? std::vector<double>{0.5, 0.5, 0.5} : options.uniform;
    if (uniform) setVector(*colour.mutable_uniform(), rgb[0], rgb[1], rgb[2]);
    if (options.colour == "fibre") colour.mutable_fibre();
    if (options.colour == "group") colour.mutable_group();
    if (options.colour == "length") setMap(*colour.mutable_length(), options);
    if (options.colour == "ends") colour.mutable_ends();
    if (distance) {
        colour.mutable_distance()->set_region(options.near);
        setMap(*colour.mutable_distance(), options);
    }
    if (point) setPointColumn(*colour.mutable_point(), options);
    if (!column || point) return;
    colour.mutable_column()->set_name(options.column);
    setMap(*colour.mutable_column(), options);
}

/// What would change nothing was meant otherwise.
void checkOptions(const FibreOptions& options) {
    const auto refuse = [](const std::string& sentence) { throw ClientError(ExitCode::kUsage, sentence); };
    if (options.datasets.empty() && anyOption(options)) {
        refuse("options of fibres need --tracts ID, the tractogram that is shown");
    }
    if (options.by_depths && options.inside.empty() && options.outside.empty()) {
        refuse("--cut-by-depths says how --cut-inside and --cut-outside cut; give one of them");
    }
    if (options.hide_unselected && options.select.empty() && options.select_groups.empty() && options.select_fibres.empty()) {
        refuse("--hide-unselected hides nothing without --select, --select-group or --select-fibre");
    }
    if (!options.slab.empty() && !(options.slab[6] > 0)) {
        refuse("--fibre-slab has a thickness of " + formatNumber(options.slab[6], 3) + " mm; it must be above 0");
    }
}

void setFibres(v1::TractogramLayer& layer, const std::string& dataset, const FibreOptions& options) {
    layer.set_dataset_id(dataset);
    setColour(*layer.mutable_colour(), options);
    if (options.line_width) layer.set_line_width_px(*options.line_width);
    if (options.tube_radius_mm) layer.set_tube_radius_mm(*options.tube_radius_mm);
    if (options.occlusion_px) layer.set_occlusion_px(*options.occlusion_px);
    if (options.halo_px) layer.set_halo_px(*options.halo_px);
    if (!options.slab.empty()) {
        const double* slab = options.slab.data();
        addCut(layer, slab, slab + 3, 1, 0.5 * slab[6]);
        addCut(layer, slab, slab + 3, -1, -0.5 * slab[6]);
    }
    for (const std::vector<double>& cut : options.cuts) addCut(layer, cut.data(), cut.data() + 3, 1, 0);
    for (const std::string& group : options.groups) layer.mutable_shown()->add_groups(group);
    for (const std::uint32_t fibre : options.fibres) layer.mutable_shown()->add_fibres(fibre);
    if (!options.length.empty()) {
        layer.mutable_shown()->set_length_min_mm(options.length[0]);
        layer.mutable_shown()->set_length_max_mm(options.length[1]);
    }
    for (const std::string& group : options.select_groups) layer.mutable_selected()->add_groups(group);
    for (const std::uint32_t fibre : options.select_fibres) layer.mutable_selected()->add_fibres(fibre);
    if (!options.show.empty()) layer.mutable_shown()->set_selection(options.show);
    if (!options.select.empty()) layer.mutable_selected()->set_selection(options.select);
    const auto addRegionCut = [&](const std::string& region, bool outside) {
        v1::FibreRegionCut& cut = *layer.add_region_cuts();
        cut.set_region(region);
        cut.set_outside(outside);
        cut.set_by_depths(options.by_depths);
    };
    for (const std::string& region : options.inside) addRegionCut(region, false);
    for (const std::string& region : options.outside) addRegionCut(region, true);
    for (const std::string& criterion : options.criteria) addCriterion(layer, criterion);
    layer.set_exact_width(options.exact_width);
    if (options.hide_unselected) layer.set_unselected(v1::UNSELECTED_FIBRES_HIDDEN);
}

}  // namespace

void addFibres(v1::Scene& scene, const FibreOptions& options) {
    checkOptions(options);
    for (const std::string& dataset : options.datasets) {
        v1::Layer& layer = *scene.add_layers();
        if (options.opacity) layer.set_opacity(*options.opacity);
        setFibres(*layer.mutable_tractogram(), dataset, options);
    }
}

void addFibreOptions(CLI::App& app, FibreOptions& options) {
    app.add_option("--tracts", options.datasets,
                   "Catalogue id of a tractogram to show, alone or with --dataset; may be given several times, for layers that "
                   "all options of fibres count for")
        ->type_name("ID")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    app.add_option("--fibre-colour", options.colour, "What colours fibres (default direction)")
        ->check(CLI::IsMember({"direction", "uniform", "fibre", "group", "column", "point", "length", "distance", "ends"}));
    app.add_option("--fibre-column", options.column,
                   "Column of --fibre-colour column, or of --fibre-colour point (NAME or NAME:COMPONENT)");
    app.add_option("--fibre-near", options.near, "Region of --fibre-colour distance, such as \"sphere(-20, 4, 12, 8)\"")
        ->type_name("REGION");
    app.add_option("--fibre-map", options.map,
                   "Colour map of --fibre-colour column, point, length and distance (default viridis)")
        ->check(CLI::IsMember({"viridis", "inferno", "cividis", "black-red-yellow", "grey"}));
    app.add_option("--fibre-range", options.range, "Ends of that map: values, or lengths in mm (default: those of all fibres)")
        ->delimiter(',')
        ->expected(2)
        ->type_name("LOW,HIGH");
    app.add_option("--fibre-uniform", options.uniform, "One colour for all fibres, linear RGB 0 to 1")
        ->delimiter(',')
        ->expected(3)
        ->type_name("R,G,B");
    app.add_option("--line-width", options.line_width, "Pixels across a line, 1 to 31 (default 1)");
    app.add_option("--tubes", options.tube_radius_mm,
                   "Draw fibres as tubes of this radius, mm; with a selection only those that are selected");
    app.add_option("--fibre-occlusion", options.occlusion_px,
                   "Ambient occlusion of fibres in screen space: radius in pixels, up to 128");
    app.add_option("--halos", options.halo_px, "Dark borders around nearer fibres: width in pixels, up to 8");
    app.add_option("--fibre-slab", options.slab, "Show what lies in a slab: point on its middle, normal (world), thickness, mm")
        ->delimiter(',')
        ->expected(7)
        ->type_name("X,Y,Z,NX,NY,NZ,MM");
    app.add_option("--cut", options.cuts, "Cut off what lies beyond a plane: point and normal, world; may be repeated")
        ->delimiter(',')
        ->expected(6)
        ->take_all()
        ->type_name("X,Y,Z,NX,NY,NZ");
    app.add_option("--group", options.groups, "Show the fibres of these groups")->delimiter(',')->type_name("NAME,...");
    app.add_option("--fibre", options.fibres, "Show the fibres of these numbers")->delimiter(',')->type_name("N,...");
    app.add_option("--length", options.length, "Show fibres of these lengths, mm")
        ->delimiter(',')
        ->expected(2)
        ->type_name("LOW,HIGH");
    app.add_option("--select-group", options.select_groups, "Let the fibres of these groups stand out")
        ->delimiter(',')
        ->type_name("NAME,...");
    app.add_option("--select-fibre", options.select_fibres, "Let these fibres stand out")->delimiter(',')->type_name("N,...");
    app.add_option("--show", options.show, "Show the fibres of a selection (docs/formats/selection.md)")
        ->type_name("SELECTION");
    app.add_option("--select", options.select, "Let the fibres of a selection stand out")->type_name("SELECTION");
    app.add_option("--cut-inside", options.inside,
                   "Show only what lies in this region, such as \"mesh(thalamus)\"; may be repeated")
        ->take_all()
        ->type_name("REGION");
    app.add_option("--cut-outside", options.outside, "Show only what lies outside of this region; may be repeated")
        ->take_all()
        ->type_name("REGION");
    app.add_flag(
        "--cut-by-depths", options.by_depths,
        "Cut by a mesh's nearest front and farthest back face in each pixel, as Schertzer et al. do: wrong where it is "
        "concave");
    app.add_option(
           "--criterion", options.criteria,
           "Show only what has values of a column within bounds: fibres, or segments for columns per point; may be repeated")
        ->take_all()
        ->type_name("COLUMN,LOW,HIGH");
    app.add_option("--fibre-opacity", options.opacity,
                   "Opacity of the fibres, above 0, up to 1: what is behind shines through, in the right order (default 1)");
    app.add_flag("--exact-width", options.exact_width,
                 "Lines have their width across, so that many samples show their true coverage");
    app.add_flag("--hide-unselected", options.hide_unselected, "Hide fibres that are not selected, instead of dimming them");
    app.add_option("--fiblet-pipeline", options.pipeline, "How fibres are drawn (default atomic)")
        ->check(CLI::IsMember({"atomic", "pull", "mesh", "mesh-serial", "geometry", "tessellation", "lines", "points"}));
    app.add_option("--fiblet-culling", options.culling,
                   "Which fiblets are decoded (default auto: two-phase, or frustum where that takes less time)")
        ->check(CLI::IsMember({"auto", "two-phase", "frustum", "none", "coverage"}));
    app.add_option("--fiblet-detail", options.detail_px,
                   "Draw fibres with fewer lines that are off by so many pixels at most, 0.05 to 16; by any pipeline but lines "
                   "and points");
    app.add_option("--freeze-culling", options.frozen,
                   "Draw only what is seen of the fibres from this camera: a JSON file or JSON text")
        ->type_name("FILE|JSON");
}

void setFibreQuality(v1::Quality& quality, const FibreOptions& options) {
    if (!options.pipeline.empty()) {
        quality.set_fiblet_pipeline(enumWords<v1::FibletPipeline>(v1::FibletPipeline_descriptor()).at(options.pipeline));
    }
    if (!options.frozen.empty()) *quality.mutable_frozen_culling() = cameraFromOption(options.frozen);
    if (options.culling == "two-phase") quality.set_fiblet_culling(v1::FIBLET_CULLING_TWO_PHASE);
    if (options.culling == "frustum") quality.set_fiblet_culling(v1::FIBLET_CULLING_FRUSTUM);
    if (options.culling == "none") quality.set_fiblet_culling(v1::FIBLET_CULLING_NONE);
    if (options.culling == "coverage") quality.set_fiblet_culling(v1::FIBLET_CULLING_COVERAGE);
    if (options.detail_px) quality.set_fiblet_detail_px(*options.detail_px);
}

}  // namespace radiata::client
