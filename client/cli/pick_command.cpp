// radiata pick: what lies under a pixel of the picture that radiata render would make with the same options.
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "radiata/v1/pick.grpc.pb.h"

#include "cli/commands.h"
#include "common/message_json.h"
#include "common/output_file.h"
#include "common/request_options.h"
#include "common/table.h"

namespace radiata::client {
namespace {

struct Options {
    RequestOptions request;
    std::vector<std::uint32_t> pixel;
    std::uint32_t radius_px = 3;
    bool all_hits = false;
    bool json = false;
};

std::string vectorText(const v1::Vec3& v, int digits) {
    return formatNumber(v.x(), digits) + ", " + formatNumber(v.y(), digits) + ", " + formatNumber(v.z(), digits);
}

std::string rankText(const v1::PickedGlyph& glyph) {
    const std::string of = std::to_string(glyph.peaks_size()) + (glyph.peaks_size() == 1 ? " peak" : " peaks");
    if (glyph.peak_rank() == 0) return "none of " + of;
    return std::to_string(glyph.peak_rank()) + " of " + of + ", " + formatNumber(glyph.peak_angle_deg(), 2) + " degrees away";
}

std::string hitText(const v1::RayHit& hit) {
    return std::string(hit.leaving() ? "leaves" : "enters") + " a " + (hit.negative_lobe() ? "negative" : "positive") +
           " lobe " + formatNumber(hit.distance_mm(), 4) + " mm from the eye at " + vectorText(hit.position_mm(), 4) +
           ", radius " + formatNumber(hit.radius_mm(), 4) + " mm along " + vectorText(hit.direction(), 4);
}

std::string describe(const v1::PickedGlyph& glyph) {
    std::vector<Row> rows = {
        {"layer", std::to_string(glyph.layer()) + " (" + glyph.dataset_id() + ")"},
        {"voxel",
         std::to_string(glyph.voxel(0)) + ", " + std::to_string(glyph.voxel(1)) + ", " + std::to_string(glyph.voxel(2))},
        {"position mm", vectorText(glyph.position_mm(), 3)},
        {"centre mm", vectorText(glyph.centre_mm(), 3)},
        {"direction", vectorText(glyph.direction(), 4)},
        {"radius mm", formatNumber(glyph.radius_mm(), 4)},
        {"amplitude", formatNumber(glyph.amplitude(), 5)},
        {"peak", rankText(glyph)},
    };
    for (int i = 0; i < glyph.peaks_size(); ++i) {
        rows.push_back({"peak " + std::to_string(i + 1),
                        formatNumber(glyph.peaks(i).amplitude(), 5) + " along " + vectorText(glyph.peaks(i).direction(), 4)});
    }
    for (int i = 0; i < glyph.hits_size(); ++i) rows.push_back({"hit " + std::to_string(i + 1), hitText(glyph.hits(i))});
    return formatTable({"picked", ""}, rows);
}

std::string describe(const v1::PickedFibre& fibre) {
    std::string groups;
    for (const std::string& group : fibre.groups()) groups += (groups.empty() ? "" : ", ") + group;
    std::vector<Row> rows = {
        {"layer", std::to_string(fibre.layer()) + " (" + fibre.dataset_id() + ")"},
        {"fibre", std::to_string(fibre.fibre())},
        {"point", std::to_string(fibre.point())},
        {"position mm", vectorText(fibre.position_mm(), 3)},
        {"tangent", vectorText(fibre.tangent(), 4)},
        {"length mm", formatNumber(fibre.length_mm(), 2)},
        {"distance pixels", formatNumber(fibre.distance_px(), 1)},
        {"groups", groups.empty() ? "none" : groups},
    };
    for (const v1::FibreValue& value : fibre.values()) {
        std::string numbers;
        for (const float number : value.numbers()) numbers += (numbers.empty() ? "" : ", ") + formatNumber(number, 5);
        rows.push_back({value.column(), numbers});
    }
    return formatTable({"picked", ""}, rows);
}

std::string describe(const v1::PickedSurface& surface) {
    return formatTable({"picked", ""}, {{"layer", std::to_string(surface.layer()) + " (" + surface.dataset_id() + ")"},
                                        {"voxel", std::to_string(surface.voxel(0)) + ", " + std::to_string(surface.voxel(1)) +
                                                      ", " + std::to_string(surface.voxel(2))},
                                        {"position mm", vectorText(surface.position_mm(), 3)},
                                        {"normal", vectorText(surface.normal(), 4)},
                                        {"value", formatNumber(surface.value(), 5)}});
}

std::string describe(const v1::PickResponse& response) {
    if (response.has_fibre()) return describe(response.fibre());
    if (response.has_surface()) return describe(response.surface());
    return response.has_glyph() ? describe(response.glyph()) : "nothing lies under this pixel\n";
}

void pick(const ConnectionOptions& connection_options, const Options& options) {
    v1::PickRequest request;
    *request.mutable_request() = makeRequest(options.request);
    request.set_x(options.pixel[0]);
    request.set_y(options.pixel[1]);
    request.set_radius_px(options.radius_px);
    request.set_all_hits(options.all_hits);
    const Connection connection(connection_options);
    completeRequest(*request.mutable_request(), connection, options.request.plane);
    grpc::ClientContext context;
    connection.prepare(context);
    v1::PickResponse response;
    connection.check(v1::PickService::NewStub(connection.channel())->Pick(&context, request, &response));
    if (options.json) {
        writeFile("-", messageToJson(response).dump(2) + "\n");
    } else {
        writeFile("-", describe(response));
    }
}

}  // namespace

void addPickCommand(CLI::App& app, const ConnectionOptions& connection) {
    const auto options = std::make_shared<Options>();
    CLI::App* command =
        app.add_subcommand("pick", "What lies under a pixel: voxel or fibre, place, direction, amplitude, peaks");
    addRequestOptions(*command, options->request, true);
    command->add_option("--pixel", options->pixel, "Column and row from the picture's upper left corner, from 0")
        ->delimiter(',')
        ->expected(2)
        ->type_name("X,Y")
        ->required();
    command->add_option("--radius", options->radius_px, "Pixels within which a fibre is looked for, 0 to 64")
        ->capture_default_str();
    command->add_flag("--all-hits", options->all_hits,
                      "All hits of the pixel's ray with the glyph under it, by the picture's --intersection");
    command->add_flag("--json", options->json, "Print JSON");
    command->callback([options, &connection] { pick(connection, *options); });
}

}  // namespace radiata::client
