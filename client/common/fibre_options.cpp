#include "common/fibre_options.h"

#include <cmath>

#include "common/client_error.h"

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
    setVector(*cut.mutable_point_mm(), point[0] + along * normal[0], point[1] + along * normal[1], point[2] + along * normal[2]);
    setVector(*cut.mutable_normal(), sign * normal[0], sign * normal[1], sign * normal[2]);
}

}  // namespace

void addFibreOptions(CLI::App& app, FibreOptions& options) {
    app.add_option("--fibre-colour", options.colour, "What colours fibres (default direction)")
        ->check(CLI::IsMember({"direction", "uniform", "fibre", "group", "column", "length"}));
    app.add_option("--fibre-column", options.column, "Column of --fibre-colour column");
    app.add_option("--line-width", options.line_width, "Pixels across a line, 1 to 31 (default 1)");
    app.add_option("--tubes", options.tube_radius_mm,
                   "Draw fibres as tubes of this radius, mm; with a selection only those that are selected");
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
    app.add_option("--length", options.length, "Show fibres of these lengths, mm")->delimiter(',')->expected(2)->type_name("LOW,HIGH");
    app.add_option("--select-group", options.select_groups, "Let the fibres of these groups stand out")
        ->delimiter(',')
        ->type_name("NAME,...");
    app.add_option("--select-fibre", options.select_fibres, "Let these fibres stand out")->delimiter(',')->type_name("N,...");
    app.add_flag("--hide-unselected", options.hide_unselected, "Hide fibres that are not selected, instead of dimming them");
    app.add_option("--fiblet-pipeline", options.pipeline, "How fibres are drawn (default atomic)")->check(CLI::IsMember({"atomic"}));
    app.add_option("--fiblet-culling", options.culling, "Which fiblets are decoded (default two-phase)")
        ->check(CLI::IsMember({"two-phase", "frustum", "none"}));
}

bool anyFibreOption(const FibreOptions& options) {
    return !options.colour.empty() || !options.column.empty() || options.line_width || options.tube_radius_mm ||
           !options.slab.empty() || !options.cuts.empty() || !options.groups.empty() || !options.fibres.empty() ||
           !options.length.empty() || !options.select_groups.empty() || !options.select_fibres.empty() || options.hide_unselected;
}

void setFibres(v1::TractogramLayer& layer, const FibreOptions& options) {
    if ((options.colour == "column") == options.column.empty()) {
        throw ClientError(ExitCode::kUsage, options.column.empty() ? "--fibre-colour column needs --fibre-column NAME"
                                                                   : "--fibre-column goes with --fibre-colour column only");
    }
    v1::FibreColour& colour = *layer.mutable_colour();
    if (options.colour == "uniform") setVector(*colour.mutable_uniform(), 0.5, 0.5, 0.5);
    if (options.colour == "fibre") colour.mutable_fibre();
    if (options.colour == "group") colour.mutable_group();
    if (options.colour == "column") colour.mutable_column()->set_name(options.column);
    if (options.colour == "length") colour.mutable_length();
    if (options.line_width) layer.set_line_width_px(*options.line_width);
    if (options.tube_radius_mm) layer.set_tube_radius_mm(*options.tube_radius_mm);
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
    if (options.hide_unselected) layer.set_unselected(v1::UNSELECTED_FIBRES_HIDDEN);
}

void setFibreQuality(v1::Quality& quality, const FibreOptions& options) {
    if (options.pipeline == "atomic") quality.set_fiblet_pipeline(v1::FIBLET_PIPELINE_ATOMIC);
    if (options.culling == "two-phase") quality.set_fiblet_culling(v1::FIBLET_CULLING_TWO_PHASE);
    if (options.culling == "frustum") quality.set_fiblet_culling(v1::FIBLET_CULLING_FRUSTUM);
    if (options.culling == "none") quality.set_fiblet_culling(v1::FIBLET_CULLING_NONE);
}

}  // namespace radiata::client
