// radiata orbit: numbered pictures of a turn about the scene, or along the cameras of a file.
#include <filesystem>
#include <iostream>
#include <memory>
#include <set>
#include <string>
#include <system_error>
#include <vector>

#include "cli/commands.h"
#include "cli/pictures.h"
#include "cli/progress.h"
#include "common/camera_json.h"
#include "common/camera_orbit.h"
#include "common/client_error.h"
#include "common/output_file.h"
#include "common/request_options.h"
#include "common/table.h"

namespace radiata::client {
namespace {

constexpr int kFramesMax = 100'000;

struct Options {
    RequestOptions request;
    int frames = 0;  ///< 0: not given
    std::optional<double> azimuth_deg;
    std::optional<double> elevation_deg;
    std::string path;
    std::string folder;
    std::string write_path;
    std::string format = "png";
    bool quiet = false;
};

void checkOptions(const Options& options) {
    if (options.path.empty()) return;
    if (options.frames > 0 || options.azimuth_deg || options.elevation_deg || !options.request.camera.empty()) {
        throw ClientError(ExitCode::kUsage,
                          "--path holds every camera; --frames, --azimuth, --elevation and --camera say nothing then");
    }
}

void makeFolder(const std::string& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (!std::filesystem::is_directory(folder)) {
        throw ClientError(ExitCode::kOutput,
                          folder + " cannot be made: " + (error ? error.message() : "a file is in its place"));
    }
    checkWritable((std::filesystem::path(folder) / "frame-0001.png").string());
}

std::vector<v1::Camera> turn(const Options& options, const v1::Camera& start) {
    const int frames = options.frames > 0 ? options.frames : 36;
    const double full_turn_step = options.elevation_deg ? 0 : 360.0 / frames;
    return orbitPath(start, frames, options.azimuth_deg.value_or(full_turn_step), options.elevation_deg.value_or(0));
}

std::string fileName(const Options& options, std::size_t index) {
    std::string number = std::to_string(index + 1);
    number.insert(0, number.size() < 4 ? 4 - number.size() : 0, '0');
    const std::string suffix = options.format == "jpeg" ? ".jpg" : ".png";
    return (std::filesystem::path(options.folder) / ("frame-" + number + suffix)).string();
}

void orbit(const ConnectionOptions& connection_options, const Options& options) {
    checkOptions(options);
    v1::FrameRequest request = makeRequest(options.request);
    std::vector<v1::Camera> cameras;
    if (!options.path.empty()) {
        cameras = readCameraPath(options.path);
        *request.mutable_camera() = cameras.front();
    }
    makeFolder(options.folder);
    if (!options.write_path.empty()) checkWritable(options.write_path);
    const Connection connection(connection_options);
    completeRequest(request, connection, options.request.plane);
    if (cameras.empty()) cameras = turn(options, request.camera());
    if (!options.write_path.empty()) writeFile(options.write_path, cameraPathToJson(cameras).dump(1) + "\n");
    std::set<std::string> left_out;
    {
        Progress progress(static_cast<int>(cameras.size()), options.quiet);
        const v1::ImageFormat format = options.format == "jpeg" ? v1::IMAGE_FORMAT_JPEG : v1::IMAGE_FORMAT_PNG;
        for (std::size_t i = 0; i < cameras.size(); ++i) {
            *request.mutable_camera() = cameras[i];
            const v1::Frame frame = renderPicture(connection, request, format, {});
            const std::string file = fileName(options, i);
            writeFile(file, frame.image());
            for (const v1::LeftOut& layer : frame.left_out()) left_out.insert(layer.texts().begin(), layer.texts().end());
            progress.step(static_cast<int>(i + 1), file + " " + formatNumber(frame.timing().render_ms(), 1) + " ms");
        }
    }
    // What any of the pictures leaves out, each once and behind the progress.
    for (const std::string& text : left_out) std::cerr << text << "\n";
}

}  // namespace

void addOrbitCommand(CLI::App& app, const ConnectionOptions& connection) {
    const auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand("orbit", "Render a turn, or a camera path, to numbered pictures");
    addRequestOptions(*command, options->request, true);
    command->add_option("-o,--output", options->folder, "Folder for frame-0001.png and so on; made if missing")
        ->type_name("FOLDER")
        ->required();
    command->add_option("--frames", options->frames, "Pictures of the turn (default 36)")->check(CLI::Range(1, kFramesMax));
    command->add_option("--azimuth", options->azimuth_deg,
                        "Degrees per picture about the camera's up axis (default: one full turn)");
    command->add_option("--elevation", options->elevation_deg, "Degrees per picture about the camera's right axis (default 0)");
    command->add_option("--path", options->path, "Cameras from a JSON file instead of a turn")->type_name("FILE");
    command->add_option("--write-path", options->write_path, "Write the cameras of the turn as a path file")->type_name("FILE");
    command->add_option("--format", options->format, "Format of the pictures")
        ->check(CLI::IsMember({"png", "jpeg"}))
        ->capture_default_str();
    command->add_flag("--quiet", options->quiet, "No progress on stderr");
    command->callback([options, &connection] { orbit(connection, *options); });
}

}  // namespace radiata::client
