// radiata-convert: makes one kind of file from another. Each conversion is a subcommand.
#include "tools/convert.h"

#include <unistd.h>

#include <cstdio>
#include <exception>

#include "base/error.h"
#include "tools/usage.h"

namespace radiata::tools {

void ShReading::addOptions(CLI::App& command) {
    command.add_option("--sh-convention", convention,
                       "How to read the image: descoteaux07, descoteaux07_legacy, tournier07 (default), mrtrix0.2");
    command.add_option("--sh-axes", axes, "Axes of its directions: world (default), voxel");
}

io::ShOptions ShReading::options() const {
    io::ShOptions options;
    if (!convention.empty()) options.convention = shConventionFromName(convention);
    if (!axes.empty()) options.axes = shAxesFromName(axes);
    return options;
}

void checkNiftiName(const std::filesystem::path& path) {
    const std::string name = path.filename().string();
    if (!name.ends_with(".nii") && !name.ends_with(".nii.gz")) {
        throw Error(Code::kInvalidArgument, path.string() + ": the name would have to end in .nii or .nii.gz");
    }
    if (path.has_parent_path() && !std::filesystem::is_directory(path.parent_path())) {
        throw Error(Code::kNotFound, path.string() + ": there is no folder " + path.parent_path().string());
    }
}

Progress::Progress(std::string what, std::size_t total)
    : what_(std::move(what)), total_(total), watched_(::isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
    if (watched_ && shown_ >= 0) std::fprintf(stderr, "\r%*s\r", static_cast<int>(what_.size()) + 8, "");
}

void Progress::add(std::size_t done) {
    if (!watched_ || total_ == 0) return;
    const int percent = static_cast<int>(100 * (done_ += done) / total_);
    int before = shown_;
    while (percent > before && !shown_.compare_exchange_weak(before, percent)) continue;
    if (percent > before) std::fprintf(stderr, "\r%s %3d %%", what_.c_str(), percent);
}

}  // namespace radiata::tools

int main(int argc, char** argv) {
    CLI::App app("Makes one kind of file from another.", "radiata-convert");
    app.require_subcommand(1);
    radiata::tools::addUncertaintyCommand(app);
    radiata::tools::addTensorsCommand(app);
    radiata::tools::addTractsCommand(app);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return radiata::tools::reportUsage(app, error);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "radiata-convert: %s\n", error.what());
        return 1;
    }
    return 0;
}
