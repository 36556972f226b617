// schertzer-table2, schertzer-table3: fibres by the paper's pipelines and ours, culled and not; and against what draws
// uncompressed points, in a turn of 1.14 degrees a frame. Source: Schertzer et al. 2022, Tables 2 and 3 (RTX 2080 Ti,
// 1920x1080; 500,000 fibres of iFOD1 at 0.1 mm, without culling: geometry 104 ms, tessellation 76.5, mesh with one thread 211,
// in parallel 44.6; with culling 84.4, 44.0, 25.6, 7.84. 434 million segments: theirs 7.87 ms, points 33, lines 91).
#include <algorithm>

#include "gpu/device.h"
#include "store/store.h"
#include "tools/lab/experiments.h"
#include "tools/lab/fibre_pipelines.h"
#include "tools/lab/measure.h"
#include "tools/lab/tract_scenes.h"

namespace radiata::lab {
namespace {

constexpr double kDegreesPerFrame = 1.14;
constexpr int kFramesOfTurn = 316, kHeight = 1080, kHeightReduced = 720;

struct Column {
    model::FibletPipeline pipeline;
    bool culled;
};

/// Times of one tractogram's frames by each column, interleaved, each column in a view of its own that turns on.
struct Turns {
    std::vector<Series> times;
    std::vector<model::FrameInfo> last;
    double million_segments = 0, set_bytes = 0;
};

Turns measureTurns(gpu::Device& device, std::size_t fibres, const std::vector<Column>& columns, int height, Report& report) {
    store::Store store(device, {});
    model::FibletSet set = ballOfFibres(fibres);
    Turns turns;
    turns.million_segments = 1e-6 * static_cast<double>(set.points - set.fibres());
    turns.set_bytes = static_cast<double>(std::span(set.heads).size_bytes() + std::span(set.codes).size_bytes() +
                                          std::span(set.boxes).size_bytes() + std::span(set.pages).size_bytes());
    store.add("fibres", std::move(set));
    render::Renderer renderer(device, store);
    report.device = renderer.deviceName();
    model::FrameRequest request = fibreFrame(height, "fibres");
    const model::Camera start =
        renderer.fitCamera("fibres", {}, model::Convention::kRadiological, static_cast<double>(request.width) / request.height);
    std::vector<render::Target> targets(columns.size());
    std::vector<std::function<void()>> frames;
    turns.last.resize(columns.size());
    std::vector<int> done(columns.size(), 0);
    for (std::size_t i = 0; i < columns.size(); ++i) {
        turns.times.push_back(
            {std::to_string(fibres) + " fibres, " + nameOf(columns[i].pipeline) + (columns[i].culled ? ", culled" : ""),
             "ms",
             {}});
        frames.push_back([&, i] {
            request.camera = model::orbit(start, kDegreesPerFrame * done[i]++, 0);
            request.quality.fiblet_pipeline = columns[i].pipeline;
            request.quality.fiblet_culling = columns[i].culled ? model::FibletCulling::kTwoPhase : model::FibletCulling::kNone;
            turns.last[i] = renderer.render(targets[i], request, 0, 1).info;
            turns.times[i].values.push_back(passTime(turns.last[i], {"fiblet"}));
        });
    }
    interleave(report.repeats, frames);
    // The first is the warm-up, which knows no picture before.
    for (Series& series : turns.times) series.values.erase(series.values.begin());
    for (const Series& series : turns.times) report.series.push_back(series);
    return turns;
}

Report begin(const std::string& name, gpu::Device& device, const Options& options, int height) {
    Report report;
    report.experiment = name;
    report.repeats = device.info().software ? options.rounds(7) : options.rounds(kFramesOfTurn);
    report.scene = "generated fibres of 800 points, 0.1 mm apart, in a ball of 140 mm";
    report.view = std::to_string(height * 16 / 9) + "x" + std::to_string(height) + ", whole, one sample, passes of fibres only";
    if (device.info().software)
        report.notes.emplace_back("A CPU driver: a subset of the paper's sizes, and a part of the turn.");
    return report;
}

std::string ratio(double of, double to) { return shortNumber(of / to); }

}  // namespace

Report schertzerTable2(gpu::Device& device, const Options& options) {
    using Pipeline = model::FibletPipeline;
    const int height = pictureHeight(device, options, kHeight, kHeightReduced);
    Report report = begin("schertzer-table2", device, options, height);
    const std::vector<std::size_t> sizes =
        device.info().software ? std::vector<std::size_t>{500, 5000} : std::vector<std::size_t>{20'000, 100'000, 500'000};
    std::vector<Column> columns;
    for (const Pipeline pipeline : {Pipeline::kGeometry, Pipeline::kTessellation, Pipeline::kMeshSerial, Pipeline::kMesh,
                                    Pipeline::kPull, Pipeline::kAtomic}) {
        for (const bool culled : {false, true}) columns.push_back({pipeline, culled});
    }
    Table table{"milliseconds a frame",
                {"pipeline", "fibres", "million segments", "without culling", "with culling", "fiblets drawn, %",
                 "without culling / atomic"},
                {}};
    double serial = 0, parallel = 0, atomic = 0;
    for (const std::size_t fibres : sizes) {
        const Turns turns = measureTurns(device, fibres, columns, height, report);
        atomic = turns.times[turns.times.size() - 2].median();
        for (std::size_t i = 0; i < columns.size(); i += 2) {
            const double all = turns.times[i].median();
            const model::FrameInfo& culled = turns.last[i + 1];
            table.rows.push_back(
                {nameOf(columns[i].pipeline), std::to_string(fibres), shortNumber(turns.million_segments), shortNumber(all),
                 shortNumber(turns.times[i + 1].median()),
                 shortNumber(100 * static_cast<double>(culled.fiblets_drawn) / static_cast<double>(culled.fiblets)),
                 ratio(all, atomic)});
            if (columns[i].pipeline == Pipeline::kMeshSerial) serial = all;
            if (columns[i].pipeline == Pipeline::kMesh) parallel = all;
        }
    }
    report.tables.push_back(table);
    report.checks.push_back({"mesh-serial / mesh, without culling", serial / parallel, ">=", 1});
    report.checks.push_back({"mesh / atomic, without culling", parallel / atomic, ">=", 10});
    noteShortfalls(report, height, pictureHeight(device, {}, kHeight, kHeightReduced));
    return report;
}

Report schertzerTable3(gpu::Device& device, const Options& options) {
    using Pipeline = model::FibletPipeline;
    const int height = pictureHeight(device, options, kHeight, kHeightReduced);
    Report report = begin("schertzer-table3", device, options, height);
    const std::vector<std::size_t> sizes =
        device.info().software ? std::vector<std::size_t>{1000, 10'000} : std::vector<std::size_t>{10'000, 100'000, 500'000};
    const std::vector<Column> columns{
        {Pipeline::kAtomic, true}, {Pipeline::kAtomic, false}, {Pipeline::kPoints, false}, {Pipeline::kLines, false}};
    const std::vector<std::string> names{"fiblets, atomic, culled", "fiblets, atomic", "uncompressed points",
                                         "uncompressed lines"};
    Table table{"milliseconds a frame, and megabytes of fibres on the device",
                {"method", "fibres", "million segments", "ms", "MB", "ms / atomic, culled"},
                {}};
    double points = 0, lines = 0;
    for (const std::size_t fibres : sizes) {
        const Turns turns = measureTurns(device, fibres, columns, height, report);
        const double ours = turns.times[0].median();
        for (std::size_t i = 0; i < columns.size(); ++i) {
            const double raw = 16e-6 * (1e6 * turns.million_segments + static_cast<double>(fibres));
            table.rows.push_back({names[i], std::to_string(fibres), shortNumber(turns.million_segments),
                                  shortNumber(turns.times[i].median()), shortNumber(i < 2 ? 1e-6 * turns.set_bytes : raw),
                                  ratio(turns.times[i].median(), ours)});
        }
        points = turns.times[2].median() / std::min(ours, turns.times[1].median());
        lines = turns.times[3].median() / std::min(ours, turns.times[1].median());
    }
    report.tables.push_back(table);
    report.checks.push_back({"uncompressed lines / fiblets by atomic, the largest", lines, ">=", 1});
    report.notes.push_back("uncompressed points / fiblets by atomic, the largest: " + shortNumber(points));
    noteShortfalls(report, height, pictureHeight(device, {}, kHeight, kHeightReduced));
    return report;
}

}  // namespace radiata::lab
