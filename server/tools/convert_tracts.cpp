// radiata-convert tracts: streamlines of any readable format to fiblets and back.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "build/fiblet_source.h"
#include "ingest/fiblet_conversion.h"
#include "io/fiblet_file.h"
#include "io/qfib.h"
#include "io/tractogram.h"
#include "tools/convert.h"

namespace radiata::tools {
namespace {

struct Settings {
    std::filesystem::path in, out;
    FibletOptions fiblets;
    bool fast = false;
    int qfib_bits = 8;
    std::uint64_t memory_mb = 512;
    io::TractOptions reading;
};

bool isQfibName(const std::filesystem::path& path) { return path.extension() == ".qfib"; }

/// Any format but .fiblet.
std::unique_ptr<model::TractogramSource> openInput(const Settings& settings) {
    return isQfibName(settings.in) ? io::openQfib(settings.in) : io::openTractogram(settings.in, settings.reading);
}

void requireFolder(const std::filesystem::path& path) {
    if (path.has_parent_path() && !std::filesystem::is_directory(path.parent_path())) {
        throw Error(Code::kNotFound, path.string() + ": there is no folder " + path.parent_path().string());
    }
}

void encode(const Settings& settings) {
    ingest::ConversionOptions options{.fiblets = settings.fiblets, .memory_bytes = settings.memory_mb << 20};
    if (settings.fast) {
        options.fiblets.beam = 0;
        options.fiblets.least_width = 8;
    }
    std::vector<std::filesystem::path> files{settings.in};
    files.insert(files.end(), settings.reading.columns.begin(), settings.reading.columns.end());
    const auto begin = std::chrono::steady_clock::now();
    ingest::Conversion done;
    {
        Progress progress(settings.in.filename().string(), 10000);
        double shown = 0;
        done = ingest::convertToFiblets([&] { return openInput(settings); }, ingest::stateOf(files), settings.out, options,
                                        [&](double share) {
                                            const auto steps = std::size_t(std::max(share - shown, 0.0) * 10000);
                                            progress.add(steps);
                                            shown += double(steps) / 10000;
                                        },
                                        [](const std::string& sentence) { std::printf("%s\n", sentence.c_str()); });
    }
    const model::FibletSet& set = done.set;
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    const double bytes = double(std::filesystem::file_size(settings.out)), points = double(set.points);
    std::printf("%s: %llu fibres, %llu points, %.3f bytes a point, error mean %.2f um, largest %.2f um; %.1f s",
                settings.out.string().c_str(), static_cast<unsigned long long>(done.fibres),
                static_cast<unsigned long long>(set.points), bytes / points, set.errors.mean_um, set.errors.max_um, seconds);
    if (done.continued == 0) std::printf(", %.2f million points a second", points / seconds * 1e-6);
    std::printf("\n");
    if (set.walked) {
        std::printf(
            "The steps vary, so points were set anew every %.4f mm; the original ones are off these lines by %.1f um on "
            "average, %.1f um at most.\n",
            double(set.codec.step_mm), set.walk_errors.mean_um, set.walk_errors.max_um);
    }
}

void decode(const Settings& settings) {
    io::requireWritableName(settings.out);
    const model::FibletSet set = io::readFiblets(settings.in);
    io::writeTractogram(*sourceOf(set), settings.out);
    std::printf("%s: %llu fibres, %llu points\n", settings.out.string().c_str(), static_cast<unsigned long long>(set.fibres()),
                static_cast<unsigned long long>(set.points));
}

void convert(const Settings& settings) {
    requireFolder(settings.out);
    const bool from = io::isFibletName(settings.in), to = io::isFibletName(settings.out);
    if (from && to)
        throw Error(Code::kInvalidArgument,
                    "both files are fiblets; encode from the original instead, each time loses a little");
    if (from && isQfibName(settings.out))
        throw Error(Code::kInvalidArgument, "fiblets do not become .qfib; take the original instead");
    if (to) {
        encode(settings);
    } else if (from) {
        decode(settings);
    } else if (isQfibName(settings.out)) {
        io::writeQfib([&] { return openInput(settings); }, settings.qfib_bits, settings.out);
    } else {
        io::requireWritableName(settings.out);
        io::writeTractogram(*openInput(settings), settings.out);
    }
}

}  // namespace

void addTractsCommand(CLI::App& app) {
    auto settings = std::make_shared<Settings>();
    CLI::App* command =
        app.add_subcommand("tracts", "Streamlines to fiblets and back, or from one format to another, by the names' endings");
    command->add_option("IN", settings->in, "Tractogram in any readable format, .fiblet or .qfib")->required();
    command->add_option("OUT", settings->out, ".fiblet, .tck, .trx or .qfib")->required();
    command->add_option("--column", settings->reading.columns,
                        "Further files with values of IN: .tsf, or text with a number per streamline");
    command->add_option("--bound", settings->fiblets.bound_um, "Largest distance between a point and its decoded one, um")
        ->capture_default_str();
    command
        ->add_option("--walk-bound", settings->fiblets.walk_bound_um,
                     "If the steps vary: largest distance of a point from the line that is stored, um")
        ->capture_default_str();
    command
        ->add_option("--step", settings->fiblets.step_mm,
                     "If the steps vary: step of the line that is stored, mm; 0: as large as --walk-bound allows")
        ->check(CLI::Range(0.0, 1000.0))
        ->capture_default_str();
    command->add_option("--beam", settings->fiblets.beam, "Width of the search: 0 (none) to 64; wider is slower and smaller")
        ->check(CLI::Range(0, 64))
        ->capture_default_str();
    command
        ->add_option("--least-bits", settings->fiblets.least_width,
                     "Bits per point at least; more are taken where the bound needs it")
        ->check(CLI::IsMember({4, 6, 8, 16}))
        ->capture_default_str();
    command->add_option("--qfib-bits", settings->qfib_bits, "Bits per point of a .qfib file")
        ->check(CLI::IsMember({8, 16}))
        ->capture_default_str();
    command
        ->add_option(
            "--memory", settings->memory_mb,
            "To .fiblet: megabytes to work in, about; what does not fit goes through OUT.runs, which a conversion that "
            "was ended leaves to the next")
        ->check(CLI::Range(16, 1 << 20))
        ->capture_default_str();
    command->add_flag("--fast", settings->fast,
                      "As --beam 0 --least-bits 8; fibres that these cannot hold within the bound are searched for");
    command->callback([settings] { convert(*settings); });
}

}  // namespace radiata::tools
