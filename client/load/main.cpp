// radiata-load: many clients that move their cameras on a fixed schedule, and what the frames' ways took.
// Exit codes as those of radiata; 4 also if a view or an update was refused during the run (the report is printed first).
#include <iostream>
#include <optional>
#include <string>

#include "radiata/v1/limits.grpc.pb.h"

#include "common/camera_json.h"
#include "common/camera_orbit.h"
#include "common/client_error.h"
#include "common/output_file.h"
#include "common/request_options.h"
#include "load/report.h"

namespace {

using namespace radiata::client;

struct Options {
    ConnectionOptions connection;
    RequestOptions request;
    Schedule schedule;
    std::string path;
    std::string json;
    std::optional<std::uint32_t> window;
    bool allow_remote = false;
};

void addOptions(CLI::App& app, Options& options) {
    addConnectionOptions(app, options.connection);
    app.add_option("--clients", options.schedule.clients, "Clients, each with one view")
        ->check(CLI::Range(1, 256))
        ->capture_default_str();
    app.add_option("--seconds", options.schedule.measured_s, "Measured time")
        ->check(CLI::Range(0.1, 3600.0))
        ->capture_default_str();
    app.add_option("--warmup", options.schedule.warmup_s, "Time before it that is not counted, seconds")
        ->check(CLI::Range(0.0, 60.0))
        ->capture_default_str();
    app.add_option("--rate", options.schedule.rate_hz, "Camera updates of a client per second")
        ->check(CLI::Range(0.1, 240.0))
        ->capture_default_str();
    app.add_option("--path", options.path, "Cameras as JSON (default: a turn in steps of one degree)")->type_name("FILE");
    app.add_option("--window", options.window, "Frames under way at most (default: the server's, 2)");
    app.add_option("--json", options.json, "Write the report as JSON; - is standard output, without the table")
        ->type_name("FILE");
    app.add_flag("--allow-remote", options.allow_remote, "Load a server that is not on this machine");
    addRequestOptions(app, options.request, true);
}

bool onThisMachine(const std::string& address) {
    for (const char* prefix : {"127.", "localhost:", "[::1]:", "unix:", "ipv4:127.", "ipv6:[::1]"}) {
        if (address.starts_with(prefix)) return true;
    }
    return false;
}

std::string device(const Connection& connection) {
    grpc::ClientContext context;
    connection.prepare(context);
    radiata::v1::GetLimitsResponse limits;
    connection.check(radiata::v1::LimitsService::NewStub(connection.channel())->GetLimits(&context, {}, &limits));
    return limits.device();
}

void printReport(const Options& options, const radiata::v1::FrameRequest& request, const std::string& drawn_by,
                 const Report& report) {
    nlohmann::ordered_json json = {{"server", options.connection.address},
                                   {"device", drawn_by},
                                   {"dataset", request.scene().layers(0).glyphs().dataset_id()},
                                   {"width", request.width()},
                                   {"height", request.height()}};
    if (options.window) json["window"] = *options.window;
    json.update(reportJson(report));
    if (options.json != "-") std::cout << reportTable(report) << std::flush;
    if (!options.json.empty()) writeFile(options.json, json.dump(2) + "\n");
}

int body(int argc, char** argv) {
    Options options;
    CLI::App app("Load harness of a Radiata server: an open-loop schedule of camera updates, latency from the scheduled time.",
                 "radiata-load");
    addOptions(app, options);
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& help) {
        return app.exit(help);
    }
    if (!options.allow_remote && !onThisMachine(options.connection.address)) {
        throw ClientError(ExitCode::kUsage,
                          options.connection.address + " is not on this machine; --allow-remote loads it all the same");
    }
    if (options.schedule.updatesPerClient() == 0)
        throw ClientError(ExitCode::kUsage, "--seconds times --rate is less than one update");
    radiata::v1::OpenRequest open;
    *open.mutable_frame() = makeRequest(options.request);
    std::vector<radiata::v1::Camera> cameras;
    if (!options.path.empty()) {
        cameras = readCameraPath(options.path);
        *open.mutable_frame()->mutable_camera() = cameras.front();
    }
    if (!options.json.empty()) checkWritable(options.json);
    if (options.window) open.set_window(*options.window);
    const Connection connection(options.connection);
    completeRequest(*open.mutable_frame(), connection, options.request.plane);
    if (cameras.empty()) cameras = orbitPath(open.frame().camera(), 360, 1, 0);
    const std::string drawn_by = device(connection);
    const Report report = makeReport(runLoad(options.connection.address, open, cameras, options.schedule), options.schedule);
    printReport(options, open.frame(), drawn_by, report);
    for (const ClientReport& client : report.clients) {
        if (!client.error.empty()) throw ClientError(ExitCode::kRefused, client.error);
    }
    return 0;
}

}  // namespace

int main(int argc, char** argv) { return radiata::client::runProgram("radiata-load", body, argc, argv); }
