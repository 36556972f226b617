// radiata lasso: which fibres lie in an outline drawn on the picture that radiata render would make with the same options.
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "radiata/v1/pick.grpc.pb.h"

#include "cli/commands.h"
#include "common/client_error.h"
#include "common/message_json.h"
#include "common/output_file.h"
#include "common/request_options.h"

namespace radiata::client {
namespace {

struct Options {
    RequestOptions request;
    std::vector<double> outline;
    bool through = false, list = false, json = false;
};

void lasso(const ConnectionOptions& connection_options, const Options& options) {
    if (options.outline.size() % 2 != 0)
        throw ClientError(ExitCode::kUsage, "--outline needs a row for each column: X,Y,X,Y,...");
    v1::PickFibresRequest request;
    *request.mutable_request() = makeRequest(options.request);
    for (std::size_t i = 0; i < options.outline.size(); i += 2) {
        v1::PicturePoint& point = *request.add_outline();
        point.set_x(options.outline[i]);
        point.set_y(options.outline[i + 1]);
    }
    request.set_through(options.through);
    if (options.list || options.json) request.set_fibres_max(0xffffffffU);
    const Connection connection(connection_options);
    completeRequest(*request.mutable_request(), connection, options.request.plane);
    grpc::ClientContext context;
    connection.prepare(context);
    v1::PickFibresResponse response;
    connection.check(v1::PickService::NewStub(connection.channel())->PickFibres(&context, request, &response));
    if (options.json) return writeFile("-", messageToJson(response).dump(2) + "\n");
    std::string text;
    for (const v1::PickedFibres& layer : response.layers()) {
        if (!options.list) text += layer.dataset_id() + ": " + std::to_string(layer.count()) + " fibres\n";
        const std::string of = options.list && response.layers_size() > 1 ? layer.dataset_id() + " " : "";
        for (const std::uint32_t fibre : layer.fibres()) text += of + std::to_string(fibre) + "\n";
    }
    writeFile("-", text);
}

}  // namespace

void addLassoCommand(CLI::App& app, const ConnectionOptions& connection) {
    const auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand("lasso", "Count or name the fibres in an outline, a box or a pixel of the picture");
    addRequestOptions(*command, options->request, true);
    command
        ->add_option(
            "--outline", options->outline,
            "Pixels from the upper left corner: an outline of three points or more, two corners of a box, or one pixel")
        ->delimiter(',')
        ->take_all()
        ->type_name("X,Y,...")
        ->required();
    command->add_flag("--through", options->through, "All fibres that pass there, whatever hides them");
    command->add_flag("--list", options->list,
                      "Print the numbers of the fibres, one a line; of several tractograms with its id before each");
    command->add_flag("--json", options->json, "Print JSON");
    command->callback([options, &connection] { lasso(connection, *options); });
}

}  // namespace radiata::client
