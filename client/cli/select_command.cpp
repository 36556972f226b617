// radiata select: which fibres of a tractogram lie where; counts them, names them, or writes them to files.
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "radiata/v1/selection.grpc.pb.h"

#include "cli/commands.h"
#include "common/client_error.h"
#include "common/message_json.h"
#include "common/output_file.h"

namespace radiata::client {
namespace {

struct Options {
    std::string dataset, selection, file;
    bool json = false, list = false;
};

v1::TractFormat formatOf(const std::string& file) {
    if (file.ends_with(".tck")) return v1::TRACT_FORMAT_TCK;
    if (file.ends_with(".trx")) return v1::TRACT_FORMAT_TRX;
    throw ClientError(ExitCode::kUsage, "--export " + file + ": the name would have to end in .tck or .trx");
}

/// Whole files only: each is written when its last bytes are there.
void exportFibres(const Connection& connection, const Options& options) {
    v1::ExportRequest request;
    request.set_dataset_id(options.dataset);
    request.set_selection(options.selection);
    request.set_format(formatOf(options.file));
    checkWritable(options.file);
    const std::string stem = options.file.substr(0, options.file.size() - 4);
    grpc::ClientContext context;
    connection.prepare(context);
    const auto stub = v1::SelectionService::NewStub(connection.channel());
    const auto reader = stub->Export(&context, request);
    v1::ExportChunk chunk;
    std::string ending, bytes;
    while (reader->Read(&chunk)) {
        if (chunk.ending() != ending && !ending.empty()) {
            writeFile(stem + ending, bytes);
            bytes.clear();
        }
        ending = chunk.ending();
        if (ending.find('/') != ending.npos) throw ClientError(ExitCode::kOutput, "the server named a file outside the folder");
        bytes += chunk.data();
    }
    connection.check(reader->Finish());
    if (!ending.empty()) writeFile(stem + ending, bytes);
}

void select(const ConnectionOptions& connection_options, const Options& options) {
    const Connection connection(connection_options);
    v1::SelectRequest request;
    request.set_dataset_id(options.dataset);
    request.set_selection(options.selection);
    if (options.list) request.set_fibres_max(0xffffffffU);
    v1::SelectResponse response;
    grpc::ClientContext context;
    connection.prepare(context);
    connection.check(v1::SelectionService::NewStub(connection.channel())->Select(&context, request, &response));
    if (!options.file.empty()) exportFibres(connection, options);
    if (options.json) return writeFile("-", messageToJson(response).dump(2) + "\n");
    std::string text;
    if (options.list) {
        for (const std::uint32_t fibre : response.fibres()) text += std::to_string(fibre) + "\n";
    } else {
        text = std::to_string(response.selected()) + " of " + std::to_string(response.fibres_total()) + " fibres\n";
    }
    writeFile("-", text);
}

}  // namespace

void addSelectCommand(CLI::App& app, const ConnectionOptions& connection) {
    const auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand("select", "Count, name or export fibres of a tractogram by regions and filters");
    command->add_option("dataset", options->dataset, "Catalogue id")->required();
    command
        ->add_option("selection", options->selection,
                     "For example \"any sphere(-20, 4, 12, 8) and not both_ends mask(csf) and length(20, 250)\"; "
                     "docs/formats/selection.md has all regions and filters")
        ->required();
    command->add_flag("--list", options->list, "Print the numbers of the fibres, one a line");
    command->add_flag("--json", options->json, "Print JSON");
    command->add_option("--export", options->file, "Write the fibres to this .tck (with files for its columns) or .trx");
    command->callback([options, &connection] { select(connection, *options); });
}

}  // namespace radiata::client
