// radiata-convert tracts: streamlines of any readable format to fiblets and back.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "build/even_steps.h"
#include "build/fiblet_source.h"
#include "build/fibre_strays.h"
#include "ingest/fiblet76_file.h"
#include "ingest/fiblet_conversion.h"
#include "io/fiblet_file.h"
#include "io/qfib.h"
#include "io/tractogram.h"
#include "tools/convert.h"
#include "tools/usage.h"

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

constexpr std::size_t kBatchPoints = std::size_t{1} << 18;

bool isQfibName(const std::filesystem::path& path) { return path.extension() == ".qfib"; }

/// Any format but .fiblet.
std::unique_ptr<model::TractogramSource> openInput(const Settings& settings) {
    if (isQfibName(settings.in)) return io::openQfib(settings.in);
    if (ingest::isFiblet76Name(settings.in)) return ingest::openFiblet76(settings.in);
    return io::openTractogram(settings.in, settings.reading);
}

/// The same without what --within leaves out.
OpenTractogram openerFor(const Settings& settings) {
    const double within = settings.fiblets.within_mm;
    if (!(within < std::numeric_limits<double>::infinity())) return [&settings] { return openInput(settings); };
    const FibreBall ball{middleOfFibres(*openInput(settings), kBatchPoints), within};
    return [&settings, ball] { return fibresWithin(openInput(settings), ball); };
}

void requireFolder(const std::filesystem::path& path) {
    if (path.has_parent_path() && !std::filesystem::is_directory(path.parent_path())) {
        throw Error(Code::kNotFound, path.string() + ": there is no folder " + path.parent_path().string());
    }
}

/// How much there is in the file, and how exact. \param errors  may be none
void printSummary(const std::filesystem::path& out, std::uint64_t fibres, std::uint64_t points,
                  const model::FibletErrors* errors) {
    std::printf("%s: %llu fibres, %llu points", out.string().c_str(), static_cast<unsigned long long>(fibres),
                static_cast<unsigned long long>(points));
    if (errors && points > 0) {
        std::printf(", %.3f bytes a point, error mean %.2f um, largest %.2f um",
                    double(std::filesystem::file_size(out)) / double(points), errors->mean_um, errors->max_um);
    }
}

void printRemarks(const std::filesystem::path& in, const std::string& remarks) {
    if (!remarks.empty()) std::printf("%s: %s\n", in.filename().string().c_str(), remarks.c_str());
}

void encode(const Settings& settings) {
    ingest::ConversionOptions options{.fiblets = settings.fiblets, .memory_bytes = settings.memory_mb << 20};
    if (settings.fast) {
        options.fiblets.beam = 0;
        options.fiblets.least_width = 8;
    }
    std::vector<std::filesystem::path> files{settings.in};
    files.insert(files.end(), settings.reading.columns.begin(), settings.reading.columns.end());
    const std::string state = ingest::stateOf(files) + std::to_string(int(settings.reading.vtk_space));
    const auto begin = std::chrono::steady_clock::now();
    ingest::Conversion done;
    {
        Progress progress(settings.in.filename().string(), 10000);
        double shown = 0;
        done = ingest::convertToFiblets([&] { return openInput(settings); }, state, settings.out, options,
                                        [&](double share) {
                                            const auto steps = std::size_t(std::max(share - shown, 0.0) * 10000);
                                            progress.add(steps);
                                            shown += double(steps) / 10000;
                                        },
                                        [](const std::string& sentence) { std::printf("%s\n", sentence.c_str()); });
    }
    const model::FibletSet& set = done.set;
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    printSummary(settings.out, done.fibres, set.points, &set.errors);
    std::printf("; %.1f s", seconds);
    if (done.continued == 0 && set.points > 0)
        std::printf(", %.2f million points a second", double(set.points) / seconds * 1e-6);
    std::printf("\n");
    if (set.walked) {
        std::printf(
            "The steps vary, so points were set anew every %.4f mm; the original ones are off these lines by %.1f um on "
            "average, %.1f um at most.\n",
            double(set.codec.step_mm), set.walk_errors.mean_um, set.walk_errors.max_um);
    }
    printRemarks(settings.in, set.remarks);
}

void decode(const Settings& settings) {
    io::requireWritableName(settings.out);
    const model::FibletSet set = io::readFiblets(settings.in);
    io::writeTractogram(*sourceOf(set), settings.out);
    printSummary(settings.out, set.fibres(), set.points, nullptr);
    std::printf("\n");
    printRemarks(settings.in, set.remarks);
}

void encodeQfib(const Settings& settings) {
    EvenStepTally tally;
    const EvenStepWish wish{settings.fiblets.step_mm, settings.fiblets.walk_bound_um, 65537};
    const OpenTractogram open = openerFor(settings);
    const io::QfibWritten done =
        io::writeQfib([&] { return std::make_unique<EvenSteps>(open(), wish, tally); }, settings.qfib_bits, settings.out);
    const model::FibletErrors errors{done.mean_um, done.max_um, done.points};
    printSummary(settings.out, done.fibres, done.points, &errors);
    std::printf("\n");
    if (tally.walked > 0) {
        std::printf(
            "The steps vary in %llu of the fibres, which the format cannot keep, so points were set anew there, a constant "
            "step "
            "apart; the original ones are off these lines by %.1f um on average, %.1f um at most.\n",
            static_cast<unsigned long long>(tally.walked), tally.errors.mean_um, tally.errors.max_um);
    }
    printRemarks(settings.in, tally.remarks);
}

void encodeFiblet76(const Settings& settings) {
    const ingest::Fiblet76Written done =
        ingest::writeFiblet76([&] { return openInput(settings); }, settings.fiblets, settings.out);
    printSummary(settings.out, done.fibres, done.points, &done.errors);
    std::printf("\n");
    if (done.walked) {
        std::printf(
            "The steps vary, so points were set anew every %.4f mm; the original ones are off these lines by %.1f um on "
            "average, %.1f um at most.\n",
            done.step_mm, done.walk_errors.mean_um, done.walk_errors.max_um);
    }
    if (done.end_um > 0) {
        std::printf("The format has no shorter last step: lines end up to %.1f um before or behind the original ends.\n",
                    done.end_um);
    }
    printRemarks(settings.in, done.remarks);
}

void reencode(const Settings& settings) {
    io::requireWritableName(settings.out);
    const auto source = openerFor(settings)();
    io::writeTractogram(*source, settings.out);
    printRemarks(settings.in, remarksOf(*source));
}

void convert(const Settings& settings) {
    requireFolder(settings.out);
    const bool from = io::isFibletName(settings.in);
    const bool to = io::isFibletName(settings.out), to_qfib = isQfibName(settings.out),
               to_76 = ingest::isFiblet76Name(settings.out);
    if (from && to)
        throw Error(Code::kInvalidArgument,
                    "both files are fiblets; encode from the original instead, each time loses a little");
    if (from && (to_qfib || to_76)) {
        throw Error(Code::kInvalidArgument,
                    "fiblets do not become " + settings.out.extension().string() + "; take the original instead");
    }
    if (to) return encode(settings);
    if (from) return decode(settings);
    if (to_qfib) return encodeQfib(settings);
    if (to_76) return encodeFiblet76(settings);
    reencode(settings);
}

}  // namespace

void addTractsCommand(CLI::App& app) {
    auto settings = std::make_shared<Settings>();
    CLI::App* command =
        app.add_subcommand("tracts", "Streamlines to fiblets and back, or from one format to another, by the names' endings");
    command->add_option("IN", settings->in, "Tractogram in any readable format, .fiblet, .fiblet76 or .qfib")->required();
    command->add_option("OUT", settings->out, ".fiblet, .tck, .trx, .qfib or .fiblet76 (the layout of the fiblets' paper)")
        ->required();
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
        ->check(numberBetween(0, 1000))
        ->capture_default_str();
    command
        ->add_option("--within", settings->fiblets.within_mm,
                     "Leave out fibres with a point farther than so many mm from the middle of the fibres (the median of their "
                     "first points); they keep their numbers")
        ->check(numberBetween(1, 1e6));
    command
        ->add_option_function<std::string>(
            "--vtk-space",
            [settings](const std::string& name) {
                settings->reading.vtk_space = name == "lps" ? io::VtkSpace::kLps : io::VtkSpace::kRas;
            },
            "Axes of a .vtk or .vtp file, whatever it says: ras, lps; else as it says, RAS if it does not")
        ->check(CLI::IsMember({"ras", "lps"}));
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
