// radiata list, info and limits: tables for people, --json for machines.
#include <iostream>
#include <memory>
#include <string>

#include "radiata/v1/catalog.grpc.pb.h"
#include "radiata/v1/limits.grpc.pb.h"

#include "cli/commands.h"
#include "common/enum_words.h"
#include "common/message_json.h"
#include "common/output_file.h"
#include "common/table.h"

namespace radiata::client {
namespace {

struct Options {
    bool json = false;
    std::string dataset;
};

void print(const std::string& text) { writeFile("-", text); }

void print(const google::protobuf::Message& message) { print(messageToJson(message).dump(2) + "\n"); }

std::string sizeText(const v1::Dataset& dataset) {
    std::string text;
    for (const std::uint32_t extent : dataset.size()) text += (text.empty() ? "" : "x") + std::to_string(extent);
    return text;
}

std::string pointText(const v1::Vec3& p) {
    return formatNumber(p.x(), 2) + ", " + formatNumber(p.y(), 2) + ", " + formatNumber(p.z(), 2);
}

std::string residence(const v1::Dataset& dataset) {
    return dataset.gpu_bytes() == 0 ? "not resident" : formatBytes(static_cast<double>(dataset.gpu_bytes()));
}

v1::ListDatasetsResponse datasets(const Connection& connection) {
    grpc::ClientContext context;
    connection.prepare(context);
    v1::ListDatasetsResponse response;
    connection.check(v1::CatalogService::NewStub(connection.channel())->ListDatasets(&context, {}, &response));
    return response;
}

v1::Dataset dataset(const Connection& connection, const std::string& id) {
    grpc::ClientContext context;
    connection.prepare(context);
    v1::GetDatasetRequest request;
    request.set_id(id);
    v1::GetDatasetResponse response;
    connection.check(v1::CatalogService::NewStub(connection.channel())->GetDataset(&context, request, &response));
    return response.dataset();
}

/// Images whose header cannot be read are listed without a size; `info` says why.
bool isUnreadable(const v1::Dataset& dataset) {
    const bool image = dataset.kind() == v1::DATASET_KIND_SH_IMAGE || dataset.kind() == v1::DATASET_KIND_TENSOR_IMAGE ||
                       dataset.kind() == v1::DATASET_KIND_SCALAR_VOLUME;
    for (const std::uint32_t extent : dataset.size()) {
        if (extent > 0) return false;
    }
    return image;
}

/// Glyphs are counted when a dataset is read, so none is not yet a number.
std::string glyphText(const v1::Dataset& dataset) {
    return dataset.glyph_count() == 0 && dataset.gpu_bytes() == 0 ? "" : std::to_string(dataset.glyph_count());
}

/// What a header says is not known before the file was read.
std::string fibreText(const v1::Dataset& dataset) {
    if (dataset.step_mm() > 0) return std::to_string(dataset.fibres());
    return dataset.fibres() == 0 ? "not read yet" : std::to_string(dataset.fibres()) + " by its header";
}

void list(const Connection& connection, const Options& options) {
    const v1::ListDatasetsResponse response = datasets(connection);
    if (options.json) return print(response);
    std::vector<Row> rows;
    for (const v1::Dataset& entry : response.datasets()) {
        if (isUnreadable(entry)) {
            rows.push_back({entry.id(), "unreadable", "", "", "", "", ""});
            continue;
        }
        const bool tracts = entry.kind() == v1::DATASET_KIND_TRACTOGRAM;
        const bool mesh = entry.kind() == v1::DATASET_KIND_MESH;
        const bool map = entry.kind() == v1::DATASET_KIND_ENVIRONMENT_MAP;
        const bool scalar = tracts || mesh || map || entry.kind() == v1::DATASET_KIND_SCALAR_VOLUME;
        rows.push_back({entry.id(), enumWord(*v1::DatasetKind_descriptor()->FindValueByNumber(entry.kind())),
                        tracts || mesh || map ? "" : sizeText(entry), scalar ? "" : std::to_string(entry.lmax()),
                        scalar ? "" : glyphText(entry), tracts ? fibreText(entry) : "",
                        scalar && (!tracts || entry.gpu_bytes() == 0) ? "" : residence(entry)});
    }
    print(formatTable({"dataset", "kind", "voxels", "lmax", "glyphs", "fibres", "GPU memory"}, rows));
}

void addGlyphRows(const v1::Dataset& entry, std::vector<Row>& rows) {
    rows.push_back({"bands", "to " + std::to_string(entry.lmax()) + (entry.full_basis() ? ", odd ones too" : ", even ones")});
    rows.push_back({"convention", entry.convention() + ", " + entry.axes() + " axes"});
    rows.push_back({"glyphs", std::to_string(entry.glyph_count())});
    rows.push_back({"rejected voxels", std::to_string(entry.rejected_voxels())});
    rows.push_back({"largest amplitude", std::to_string(entry.amplitude_max())});
}

template <typename Names>
std::string joined(const Names& names) {
    std::string text;
    for (const auto& name : names) text += (text.empty() ? "" : ", ") + name;
    return text.empty() ? "none" : text;
}

/// Bytes on the device, and of how much of the tractogram they are.
std::string tractResidence(const v1::Dataset& entry) {
    if (entry.gpu_bytes() == 0) return residence(entry);
    const std::string bytes = residence(entry) + " (" + std::to_string(entry.gpu_bytes()) + " bytes)";
    if (entry.resident_pages() >= entry.fiblet_pages()) return bytes + ", all of it";
    return bytes + ", " + std::to_string(entry.resident_pages()) + " of " + std::to_string(entry.fiblet_pages()) +
           " pages and a subset";
}

std::string stepText(const v1::Dataset& entry) {
    const std::string step = formatNumber(entry.step_mm(), 4) + " mm, ";
    if (entry.set_anew_max_um() == 0) return step + "points as in the file";
    return step + "points set anew; those of the file are off these lines by " + formatNumber(entry.set_anew_mean_um(), 1) +
           " um on average, " + formatNumber(entry.set_anew_max_um(), 1) + " um at most";
}

std::string describeTracts(const v1::Dataset& entry) {
    std::vector<std::string> groups;
    for (const v1::FibreGroupSize& group : entry.fibre_groups()) {
        groups.push_back(group.name() + " (" + std::to_string(group.fibres()) + ")");
    }
    return formatTable(
        {"dataset", entry.id()},
        {{"kind", enumWord(*v1::DatasetKind_descriptor()->FindValueByNumber(entry.kind()))},
         {"fibres", fibreText(entry)},
         {"points", std::to_string(entry.points())},
         {"error um", formatNumber(entry.error_mean_um(), 2) + " mean, " + formatNumber(entry.error_max_um(), 2) + " at most"},
         {"step", stepText(entry)},
         {"remarks", entry.remarks().empty() ? "none" : entry.remarks()},
         {"groups", joined(groups)},
         {"columns per fibre", joined(entry.fibre_columns())},
         {"columns per vertex", joined(entry.vertex_columns())},
         {"GPU memory", tractResidence(entry)},
         {"bounds minimum mm", pointText(entry.bounds_world().minimum())},
         {"bounds maximum mm", pointText(entry.bounds_world().maximum())}});
}

std::string describeMap(const v1::Dataset& entry) {
    return formatTable(
        {"dataset", entry.id()},
        {{"kind", enumWord(*v1::DatasetKind_descriptor()->FindValueByNumber(entry.kind()))},
         {"pixels", entry.size_size() < 2 ? "" : std::to_string(entry.size(0)) + "x" + std::to_string(entry.size(1))},
         {"luminance", formatNumber(entry.value_min(), 4) + " to " + formatNumber(entry.value_max(), 4)}});
}

std::string describeMesh(const v1::Dataset& entry) {
    return formatTable({"dataset", entry.id()}, {{"kind", "mesh"},
                                                 {"points", std::to_string(entry.points())},
                                                 {"triangles", std::to_string(entry.triangles())},
                                                 {"bounds minimum mm", pointText(entry.bounds_world().minimum())},
                                                 {"bounds maximum mm", pointText(entry.bounds_world().maximum())}});
}

std::string describe(const v1::Dataset& entry) {
    if (entry.kind() == v1::DATASET_KIND_MESH) return describeMesh(entry);
    if (entry.kind() == v1::DATASET_KIND_TRACTOGRAM) return describeTracts(entry);
    if (entry.kind() == v1::DATASET_KIND_ENVIRONMENT_MAP) return describeMap(entry);
    const bool scalar = entry.kind() == v1::DATASET_KIND_SCALAR_VOLUME;
    std::vector<Row> rows = {
        {"kind", enumWord(*v1::DatasetKind_descriptor()->FindValueByNumber(entry.kind()))},
        {"voxels", sizeText(entry)},
    };
    if (scalar) {
        rows.push_back({"values", formatNumber(entry.value_min(), 4) + " to " + formatNumber(entry.value_max(), 4)});
        rows.push_back({"voxels without a value", std::to_string(entry.rejected_voxels())});
    } else {
        addGlyphRows(entry, rows);
    }
    rows.push_back({"bounds minimum mm", pointText(entry.bounds_world().minimum())});
    rows.push_back({"bounds maximum mm", pointText(entry.bounds_world().maximum())});
    for (int r = 0; r * 4 + 3 < entry.voxel_to_world().rows_size(); ++r) {
        std::string row;
        for (int c = 0; c < 4; ++c) row += (c == 0 ? "" : ", ") + formatNumber(entry.voxel_to_world().rows(r * 4 + c), 4);
        rows.push_back({r == 0 ? "voxel to world" : "", row});
    }
    const std::string exact = entry.gpu_bytes() == 0 ? "" : " (" + std::to_string(entry.gpu_bytes()) + " bytes)";
    if (!scalar) rows.push_back({"GPU memory", residence(entry) + exact});
    return formatTable({"dataset", entry.id()}, rows);
}

void info(const Connection& connection, const Options& options) {
    if (!options.dataset.empty()) {
        const v1::Dataset entry = dataset(connection, options.dataset);
        return options.json ? print(entry) : print(describe(entry));
    }
    const v1::ListDatasetsResponse response = datasets(connection);
    if (options.json) return print(response);
    std::string text;
    for (const v1::Dataset& entry : response.datasets()) text += (text.empty() ? "" : "\n") + describe(entry);
    print(text);
}

void limits(const Connection& connection, const Options& options) {
    grpc::ClientContext context;
    connection.prepare(context);
    v1::GetLimitsResponse response;
    connection.check(v1::LimitsService::NewStub(connection.channel())->GetLimits(&context, {}, &response));
    if (options.json) return print(response);
    std::string traversals;
    for (const std::string& name : response.traversals()) traversals += (traversals.empty() ? "" : ", ") + name;
    const std::vector<Row> rows = {
        {"version", response.version()},
        {"device", response.device()},
        {"traversals", traversals},
        {"picture", std::to_string(response.width_max()) + "x" + std::to_string(response.height_max()) + " pixels, " +
                        std::to_string(response.pixels_max()) + " in all"},
        {"samples per pixel", std::to_string(response.samples_max())},
        {"rays of soft shadows", std::to_string(response.shadow_rays_max()) + " per sample, light's radius up to " +
                                     formatNumber(response.angular_radius_max_deg(), 0) + " degrees"},
        {"rays of ambient occlusion", std::to_string(response.occlusion_rays_max()) + " per sample"},
        {"pieces of a marched ray", std::to_string(response.ray_march_steps_max())},
        {"highest band", std::to_string(response.band_max())},
        {"highest order of tensors", std::to_string(response.tensor_order_max())},
        {"tessellated glyphs", std::to_string(response.mesh_vertices_max()) + " vertices each, " +
                                   std::to_string(response.layer_triangles_max()) + " triangles of a layer"},
        {"layers", std::to_string(response.layers_max())},
        {"open views", std::to_string(response.views_max())},
        {"unacknowledged frames", std::to_string(response.window_max())},
        {"GPU memory of a tractogram", response.tract_memory_bytes() == 0
                                           ? "as much as it takes"
                                           : formatBytes(static_cast<double>(response.tract_memory_bytes()))},
        {"request", formatBytes(static_cast<double>(response.message_bytes_max()))},
    };
    print(formatTable({"limit", "value"}, rows));
}

}  // namespace

void addCatalogCommands(CLI::App& app, const ConnectionOptions& connection) {
    const auto options = std::make_shared<Options>();
    const auto add = [&](const std::string& name, const std::string& what, void (*run)(const Connection&, const Options&)) {
        CLI::App* command = app.add_subcommand(name, what);
        command->add_flag("--json", options->json, "Print JSON");
        command->callback([options, &connection, run] { run(Connection(connection), *options); });
        return command;
    };
    add("list", "List the datasets", list);
    add("info", "Everything about one dataset, or about all", info)->add_option("dataset", options->dataset, "Catalogue id");
    add("limits", "What the server accepts, and the device that draws", limits);
}

}  // namespace radiata::client
