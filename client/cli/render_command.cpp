// radiata render: one picture, and beside it any of the lossless outputs as .npy and what is known about the frame as JSON.
#include <filesystem>
#include <functional>
#include <iostream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "cli/commands.h"
#include "cli/npy.h"
#include "cli/pictures.h"
#include "common/client_error.h"
#include "common/message_json.h"
#include "common/output_file.h"
#include "common/request_options.h"

namespace radiata::client {
namespace {

struct Options {
    RequestOptions request;
    std::string picture;
    std::string format;
    std::string info;
    bool stream = false;
    std::vector<std::pair<v1::Output, std::string>> arrays = {{v1::OUTPUT_DEPTH, ""},
                                                              {v1::OUTPUT_ID, ""},
                                                              {v1::OUTPUT_POSITION, ""},
                                                              {v1::OUTPUT_NORMAL, ""},
                                                              {v1::OUTPUT_STEPS, ""}};
};

bool endsLikeJpeg(const std::string& file) { return file.ends_with(".jpg") || file.ends_with(".jpeg"); }

/// A picture would not be what its name says.
void checkPictureName(const Options& options) {
    const std::string ending = std::filesystem::path(options.picture).extension().string();
    if (!options.format.empty() || ending.empty() || ending == ".png" || endsLikeJpeg(ending)) return;
    throw ClientError(ExitCode::kUsage,
                      options.picture + " ends in " + ending + "; pictures are .png, .jpg or .jpeg, or what --format says");
}

v1::ImageFormat imageFormat(const Options& options) {
    const bool jpeg = options.format.empty() ? endsLikeJpeg(options.picture) : options.format == "jpeg";
    return jpeg ? v1::IMAGE_FORMAT_JPEG : v1::IMAGE_FORMAT_PNG;
}

std::vector<v1::Output> wantedOutputs(const Options& options) {
    std::vector<v1::Output> outputs;
    for (const auto& [output, file] : options.arrays) {
        if (!file.empty()) outputs.push_back(output);
    }
    return outputs;
}

void checkOptions(const Options& options) {
    std::vector<std::string> files;
    for (const auto& [output, file] : options.arrays) files.push_back(file);
    files.push_back(options.picture);
    files.push_back(options.info);
    std::erase(files, "");
    if (files.empty()) throw ClientError(ExitCode::kUsage, "nothing to write; -o FILE names the picture");
    for (std::size_t i = 0; i < files.size(); ++i) {
        for (std::size_t k = 0; k < i; ++k) {
            if (files[i] == files[k]) throw ClientError(ExitCode::kUsage, "two outputs would be written to " + files[i]);
        }
    }
    checkPictureName(options);
    const bool stream = options.stream || options.request.light.illumination.full;
    const std::string way = options.stream ? "--stream" : "--full";
    if (stream && !wantedOutputs(options).empty()) {
        throw ClientError(ExitCode::kUsage, "a stream carries pictures only; leave " + way + " out to get the arrays");
    }
    if (stream && imageFormat(options) == v1::IMAGE_FORMAT_JPEG) {
        throw ClientError(ExitCode::kUsage, "a picture at rest is streamed as PNG; leave " + way + " out to get a JPEG");
    }
    for (const std::string& file : files) checkWritable(file);
}

void writeArrays(const Options& options, const v1::Frame& frame) {
    for (const auto& [output, file] : options.arrays) {
        if (file.empty()) continue;
        const v1::OutputArray* found = nullptr;
        for (const v1::OutputArray& array : frame.outputs()) {
            if (array.output() == output) found = &array;
        }
        if (found == nullptr) throw ClientError(ExitCode::kRefused, "the server sent no array for " + file);
        writeFile(file, npyBytes(*found, frame.width(), frame.height()));
    }
}

void render(const ConnectionOptions& connection_options, const Options& options) {
    v1::FrameRequest request = makeRequest(options.request);
    checkOptions(options);
    const Connection connection(connection_options);
    completeRequest(request, connection, options.request.plane);
    const v1::Illumination& light = request.scene().light().illumination();
    const bool whole = light.full();
    // A line for each frame of a whole lattice, which may take hours.
    const auto showProgress = [&light](const v1::Frame& frame) {
        if (frame.has_illumination()) std::cerr << describe(frame.illumination(), light) << "\n";
    };
    const v1::Frame frame =
        options.stream || whole
            ? streamPicture(connection, request, whole ? std::function<void(const v1::Frame&)>(showProgress) : nullptr)
            : renderPicture(connection, request, imageFormat(options), wantedOutputs(options));
    if (frame.image().empty()) throw ClientError(ExitCode::kRefused, "the server's frame has no picture");
    showProgress(frame);
    for (const v1::LeftOut& left_out : frame.left_out()) {
        for (const std::string& text : left_out.texts()) std::cerr << text << "\n";
    }
    writeArrays(options, frame);
    if (!options.info.empty()) writeFile(options.info, messageToJson(frame).dump(2) + "\n");
    if (!options.picture.empty()) writeFile(options.picture, frame.image());
}

}  // namespace

void addRenderCommand(CLI::App& app, const ConnectionOptions& connection) {
    const auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand("render", "Render one picture");
    addRequestOptions(*command, options->request, true);
    command->add_option("-o,--output", options->picture, "Picture; - is standard output")->type_name("FILE");
    command->add_option("--format", options->format, "Format of the picture (default: by the file's name, else png)")
        ->check(CLI::IsMember({"png", "jpeg"}));
    // The plain names of two arrays belong to the plane's position and normal.
    const std::vector<std::pair<std::string, std::string>> names = {
        {"--depth,--depth-out", "Depth along the line of sight, mm"},
        {"--id,--id-out", "Layer and voxel"},
        {"--position-out", "World position, mm"},
        {"--normal-out", "Normal, world axes"},
        {"--steps,--steps-out", "Steps of the march"}};
    for (std::size_t i = 0; i < names.size(); ++i) {
        command->add_option(names[i].first, options->arrays[i].second, names[i].second + ", as .npy")->type_name("FILE");
    }
    command->add_option("--info", options->info, "What is known about the frame, as JSON")->type_name("FILE");
    command->add_flag("--stream", options->stream, "Take the picture from a live view once it has come to rest");
    command->callback([options, &connection] { render(connection, *options); });
}

}  // namespace radiata::client
