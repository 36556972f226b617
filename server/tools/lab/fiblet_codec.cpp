// fiblet-codec: bytes a point (of the file, everything included), errors and speed of the encoder by width of the search, bits
// and bound.
#include <chrono>
#include <filesystem>
#include <functional>
#include <thread>

#include <unistd.h>

#include "build/fiblet_encode.h"
#include "io/fiblet_file.h"
#include "tools/lab/experiments.h"
#include "tools/lab/tract_scenes.h"

namespace radiata::lab {
namespace {

struct Setting {
    std::string name;
    FibletOptions options;
};

std::vector<Setting> settings() {
    const auto of = [](double bound_um, std::uint32_t beam, std::uint32_t bits) {
        FibletOptions options;
        options.bound_um = bound_um;
        options.beam = beam;
        options.least_width = bits;
        return options;
    };
    std::vector<Setting> all{{"compact (beam 8, 4 bits, 10 um)", of(10, 8, 4)}, {"fast (greedy, 8 bits, 10 um)", of(10, 0, 8)}};
    for (const std::uint32_t beam : {0U, 1U, 2U, 4U, 8U, 16U, 32U, 64U}) {
        all.push_back({"beam " + std::to_string(beam) + ", 4 bits, any error", of(1e4, beam, 4)});
    }
    for (const std::uint32_t bits : {6U, 8U, 16U})
        all.push_back({"beam 8, " + std::to_string(bits) + " bits, any error", of(1e4, 8, bits)});
    for (const double bound : {1.0, 3.0, 5.0, 20.0})
        all.push_back({"beam 8, 4 bits, " + shortNumber(bound) + " um", of(bound, 8, 4)});
    return all;
}

double fileBytes(const model::FibletSet& set) {
    const std::filesystem::path path =
        std::filesystem::temp_directory_path() / ("radiata_codec_" + std::to_string(::getpid()) + ".fiblet");
    io::writeFiblets(set, path);
    const double bytes = double(std::filesystem::file_size(path));
    std::filesystem::remove(path);
    return bytes;
}

}  // namespace

Report fibletCodec(gpu::Device&, const Options& options) {
    Report report;
    report.experiment = "fiblet-codec";
    report.device = std::to_string(std::thread::hardware_concurrency()) + " processors";
    report.repeats = options.rounds(7);
    const std::vector<Setting> all = settings();
    const auto scenes = tractScenes(options.size > 0 ? std::size_t(options.size) : 200, options.tracts);
    for (const TractScene& scene : scenes) {
        const double points = double(scene.tractogram.fibres.points.size());
        report.scene += (report.scene.empty() ? "" : "; ") + scene.name + ": " + std::to_string(scene.tractogram.fibreCount()) +
                        " fibres, " + std::to_string(scene.tractogram.fibres.points.size()) + " points";
        std::vector<Series> speeds(all.size());
        std::vector<model::FibletSet> sets(all.size());
        std::vector<std::function<void()>> measurements;
        for (std::size_t i = 0; i < all.size(); ++i) {
            speeds[i].name = scene.name + ": " + all[i].name;
            speeds[i].unit = "million points/s";
            measurements.push_back([&, i] {
                const auto begin = std::chrono::steady_clock::now();
                sets[i] = encodeFiblets(scene.tractogram, all[i].options);
                speeds[i].values.push_back(points * 1e-6 /
                                           std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
            });
        }
        interleave(report.repeats, measurements);
        Table table{
            scene.name, {"setting", "bytes/point", "mean um", "max um", "million points/s", "fiblets of 4, 6, 8, 16 bits"}, {}};
        for (std::size_t i = 0; i < all.size(); ++i) {
            speeds[i].values.erase(speeds[i].values.begin());  // of warming up
            std::size_t widths[4] = {};
            for (const model::FibletHead& head : sets[i].heads) ++widths[head.shape >> 6 & 3];
            table.rows.push_back({all[i].name, shortNumber(fileBytes(sets[i]) / points), shortNumber(sets[i].errors.mean_um),
                                  shortNumber(sets[i].errors.max_um), shortNumber(speeds[i].median()),
                                  std::to_string(widths[0]) + ", " + std::to_string(widths[1]) + ", " +
                                      std::to_string(widths[2]) + ", " + std::to_string(widths[3])});
        }
        report.tables.push_back(std::move(table));
        if (scene.checked) {
            const std::string of = scene.name + ": ";
            report.checks.push_back({of + "compact, bytes a point", fileBytes(sets[0]) / points, "<=", 0.95});
            report.checks.push_back({of + "compact, mean um", sets[0].errors.mean_um, "<=", 3});
            report.checks.push_back({of + "compact, million points/s", speeds[0].median(), ">=", 0.5});
            report.checks.push_back({of + "fast, million points/s", speeds[1].median(), ">=", 3});
        }
        for (std::size_t i = 0; i < 2; ++i) report.series.push_back(speeds[i]);
    }
    report.notes.push_back(
        "With turns uniform in a cap of angle a the distance-rate bound of 4 bits a point is a "
        "mean of about "
        "0.14 a times the step: 1.7 um at 7.2 degrees, 3.5 um at 15 degrees.");
    return report;
}

}  // namespace radiata::lab
