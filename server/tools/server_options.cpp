#include "tools/server_options.h"

#include <cstdlib>
#include <map>

#include <CLI/CLI.hpp>

#include "tools/usage.h"

namespace radiata::tools {
namespace {

/// $XDG_CACHE_HOME/radiata/NAME, or nothing where there is no home.
std::filesystem::path defaultCache(const char* name) {
    if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache && *cache) {
        return std::filesystem::path(cache) / "radiata" / name;
    }
    if (const char* home = std::getenv("HOME"); home && *home) {
        return std::filesystem::path(home) / ".cache" / "radiata" / name;
    }
    return {};
}

/// "width=4096" and so on. \throws CLI::ValidationError
void applyLimit(const std::string& text, model::Limits& limits) {
    const std::size_t equals = text.find('=');
    const std::string key = text.substr(0, equals);
    std::uint64_t value = 0;
    const bool number = equals != std::string::npos && CLI::detail::lexical_cast(text.substr(equals + 1), value);
    if (!number || value < 1 || value > (1U << 30)) {
        throw CLI::ValidationError("--limits", "\"" + text + "\" is not KEY=NUMBER with a number of 1 to 1073741824");
    }
    if (key == "pixels") {
        limits.pixels_max = std::min<std::uint64_t>(value, encode::kPixelsMax);
        return;
    }
    const std::map<std::string, int*> keys = {{"width", &limits.width_max},
                                              {"height", &limits.height_max},
                                              {"samples", &limits.samples_max},
                                              {"views", &limits.views_max},
                                              {"window", &limits.window_max}};
    const auto found = keys.find(key);
    if (found == keys.end()) {
        throw CLI::ValidationError("--limits", "\"" + key + "\" is not width, height, pixels, samples, views or window");
    }
    *found->second = static_cast<int>(value);
}

/// What CLI11 fills in before it becomes options.
struct Texts {
    std::string convention, axes, traversal, tensor_axes, vtk_space;
    std::vector<std::string> limits, tensors;
};

void addFlags(CLI::App& app, ProgramOptions& options, Texts& texts) {
    app.add_option("--listen", options.server.listen, "HOST:PORT to serve on; port 0 takes a free one")->capture_default_str();
    app.add_flag("--allow-remote", options.server.allow_remote,
                 "Let --listen name an address that other machines reach; there is no encryption or login here");
    app.add_option(
        "--data", options.data,
        "Folder of images and tractograms, or one; may be repeated. Images with one volume colour glyphs, the others are SH");
    app.add_option(
        "--tensors", texts.tensors,
        "FORMAT=PATH of an image or folder of tensors; formats: mrtrix, dipy, fsl, voigt-stiffness, voigt-compliance, "
        "mandel, symmetric, entries; may be repeated");
    app.add_option("--tensor-axes", texts.tensor_axes,
                   "Axes of the directions in tensor images, where not the format's: world, voxel");
    app.add_option("--device", options.device.device, "Vulkan device: its number in --list-devices, or a part of its name");
    app.add_flag("--list-devices", options.list_devices, "Print the Vulkan devices and end");
    app.add_option("--without", options.device.without, "Device feature to leave unused, e.g. ray_query; may be repeated");
    app.add_flag("--validation", options.device.validation, "Vulkan validation layers, with synchronisation validation");
    app.add_option("--traversal", texts.traversal, "Way of finding glyphs for requests that leave it open")
        ->check(CLI::IsMember({"auto", "ray_query", "bvh", "tiles", "raster_boxes"}));
    app.add_flag("--test-pipelines", options.test_pipelines,
                 "Test all ways to draw fibres at the start and say which work; else each is tested before its first use");
    app.add_option("--sh-convention", texts.convention,
                   "How to read SH images: descoteaux07, descoteaux07_legacy, tournier07, mrtrix0.2");
    app.add_option("--sh-axes", texts.axes, "Axes of the directions in SH images: world, voxel");
    app.add_option("--pipeline-cache", options.device.pipeline_cache, "File that keeps compiled pipelines")
        ->capture_default_str();
    app.add_option("--tract-cache", options.tract_cache,
                   "Folder that keeps tractograms once they are encoded; empty: none is kept")
        ->capture_default_str();
    app.add_option_function<double>(
           "--tract-memory",
           [&options](double mebibytes) {
               options.settings.limits.tract_memory_bytes =
                   mebibytes > 0 ? static_cast<std::uint64_t>(mebibytes * (1 << 20)) : 0;
           },
           "MiB of device memory for the fiblets of one tractogram; of larger ones parts are read from disk as they are seen; "
           "0: as much as it takes (default)")
        ->check(numberBetween(0, 16'777'216));
    app.add_option("--vtk-space", texts.vtk_space,
                   "Axes of .vtk and .vtp tractograms, whatever they say: ras, lps; else as each says, RAS if it does not")
        ->check(CLI::IsMember({"ras", "lps"}));
    app.add_option("--lattice-folder", options.lattice_folder,
                   "Folder that keeps illumination lattices that were asked for as a whole (default: beside their datasets)");
    app.add_option("--limits", texts.limits,
                   "KEY=NUMBER; keys: width, height, pixels, samples, views, window; may be repeated");
    app.add_option("--stub-render", options.stub_render_ms,
                   "Paint instead of rendering, MS milliseconds a sample; needs no device")
        ->check(CLI::Range(0, 60'000));
    app.add_option("--threads", options.settings.encoder_threads, "Threads that encode pictures")
        ->check(CLI::Range(1, 64))
        ->capture_default_str();
    app.add_option("--font", options.settings.font, "TrueType file for the marks on pictures")->capture_default_str();
    app.add_option("--log-level", options.log_level, "What is logged")
        ->check(CLI::IsMember({"debug", "info", "warn", "error", "off"}))
        ->capture_default_str();
}

/// gRPC takes 65536 for 0 and any word for a name to look up, and says so late or never.
void checkListen(const std::string& listen) {
    if (listen.starts_with("unix:") || listen.starts_with("unix-abstract:")) return;
    const std::size_t colon = listen.rfind(':');
    const std::string port = colon == std::string::npos ? "" : listen.substr(colon + 1);
    const bool number = !port.empty() && port.size() < 6 && port.find_first_not_of("0123456789") == std::string::npos;
    if (colon == 0 || !number || std::stoi(port) > 65535) {
        throw CLI::ValidationError("--listen", "\"" + listen + "\" is not HOST:PORT with a port of 0 to 65535, nor unix:PATH");
    }
}

void finish(ProgramOptions& options, const Texts& texts) {
    checkListen(options.server.listen);
    if (!texts.convention.empty()) options.sh.convention = shConventionFromName(texts.convention);
    if (!texts.axes.empty()) options.sh.axes = shAxesFromName(texts.axes);
    if (texts.vtk_space == "ras") options.vtk_space = io::VtkSpace::kRas;
    if (texts.vtk_space == "lps") options.vtk_space = io::VtkSpace::kLps;
    if (texts.traversal == "ray_query") options.traversal = model::Traversal::kRayQuery;
    if (texts.traversal == "bvh") options.traversal = model::Traversal::kBvh;
    if (texts.traversal == "tiles") options.traversal = model::Traversal::kTiles;
    for (const std::string& text : texts.tensors) {
        const std::size_t equals = text.find('=');
        if (equals == std::string::npos) throw CLI::ValidationError("--tensors", "\"" + text + "\" is not FORMAT=PATH");
        io::TensorOptions how;
        how.format = io::tensorFormatFromName(text.substr(0, equals));
        if (!texts.tensor_axes.empty()) how.axes = shAxesFromName(texts.tensor_axes);
        options.tensors.emplace_back(how, text.substr(equals + 1));
    }
    if (texts.traversal == "raster_boxes") options.traversal = model::Traversal::kRasterBoxes;
    for (const std::string& limit : texts.limits) applyLimit(limit, options.settings.limits);
}

}  // namespace

std::optional<ProgramOptions> parseOptions(int argc, char** argv, int& exit_code) {
    ProgramOptions options;
    options.device.pipeline_cache = defaultCache("pipelines");
    options.tract_cache = defaultCache("fiblets");
    Texts texts;
    CLI::App app("Renders diffusion-MRI pictures on the GPU and streams them over gRPC. Not for diagnostic use.",
                 "radiata-server");
    addFlags(app, options, texts);
    try {
        app.parse(argc, argv);
        finish(options, texts);
    } catch (const CLI::ParseError& error) {
        exit_code = reportUsage(app, error);
        return std::nullopt;
    }
    return options;
}

}  // namespace radiata::tools
