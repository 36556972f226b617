// peters-bounds: boxes of glyphs. The paper's (256 k samples and Newton's method from the best, enlarged by 2.5 or 3.5 %): how
// far they fall short before and after the enlargement; ours (certified): how far they exceed; and the time per glyph of both,
// on the CPU's threads and on the device, against a frame of as many glyphs. Source: Peters et al. 2023, Sec. 4.2 (up to 1.9 %
// short for k <= 8 and 3.07 % above; 29 us per glyph at k = 4, one thread).
#include <algorithm>

#include <chrono>
#include <mutex>
#include <numeric>

#include "base/parallel.h"
#include "gpu/device.h"
#include "store/device_bounds.h"
#include "store/glyph_dataset.h"
#include "tools/lab/experiments.h"
#include "tools/lab/measure.h"
#include "tools/lab/peters_box.h"
#include "tools/lab/scenes.h"
#include "tools/lab/statistics.h"

namespace radiata::lab {
namespace {

constexpr std::size_t kGlyphs = 500;  // for the shortfalls; the paper's 100,000 need an hour of exact boxes
constexpr std::uint64_t kSliceGlyphs = 19600;
constexpr int kFrameHeight = 720;

double millisecondsOf(const std::function<void()>& work) {
    const auto begin = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

struct Shortfall {
    double samples = 0, peters = 0;  ///< largest share by which a box is too small before enlargement
    std::size_t glyphs_short = 0;    ///< still too small after the paper's enlargement
    double certified_least = 1e30, certified_median = 0, certified_most = 0;  ///< certified over exact half extent
};

Shortfall shortfallOf(int k, std::size_t glyphs, const std::function<std::vector<float>(std::size_t)>& glyph) {
    const ShLayout layout{k, false};
    const PetersBoxes peters(k);
    const BoundsEvaluator evaluator(layout);
    Shortfall sum;
    std::vector<double> ratios;
    std::mutex mutex;
    parallelFor(glyphs, 8, [&](std::size_t begin, std::size_t end) {
        for (std::size_t g = begin; g < end; ++g) {
            const std::vector<float> coefficients = glyph(g);
            const HalfExtents box = peters.box(coefficients, true);
            GlyphBounds bounds;
            evaluator.evaluate(coefficients, true, {&bounds, 1});
            const std::lock_guard lock(mutex);
            bool is_short = false;
            for (int axis = 0; axis < 3; ++axis) {
                sum.samples = std::max(sum.samples, 1 - box.of_samples[axis] / box.exact[axis]);
                sum.peters = std::max(sum.peters, 1 - box.of_peters[axis] / box.exact[axis]);
                is_short = is_short || box.of_peters[axis] * peters.enlargement() < box.exact[axis];
                ratios.push_back(static_cast<double>(bounds.max[axis]) / box.exact[axis]);
            }
            sum.glyphs_short += is_short;
        }
    });
    sum.certified_least = quantile(ratios, 0);
    sum.certified_median = quantile(ratios, 0.5);
    sum.certified_most = quantile(ratios, 1);
    return sum;
}

std::string percent(double share) { return shortNumber(100 * share) + " %"; }

void addShortfalls(Report& report) {
    Table table{"half extents against exact ones, " + std::to_string(kGlyphs) + " glyphs of uniform coefficients in [-1, 1]",
                {"k", "samples", "best sample short by", "paper's box short by", "short after enlargement", "enlarged by",
                 "certified / exact: least", "median", "most"},
                {}};
    Plot plot{"boxes against exact ones", "k", "per cent", false, false, false, {}};
    Curve paper{"paper's box, largest shortfall before enlargement", {}, true};
    Curve certified{"certified box, median excess", {}, true}, margin{"paper's enlargement", {}, true};
    for (int k = 2; k <= 16; k += 2) {
        const Shortfall s = shortfallOf(k, kGlyphs, [k](std::size_t g) {
            return uniformGlyph({k, false}, static_cast<std::uint32_t>(1000 * static_cast<std::size_t>(k) + g));
        });
        const PetersBoxes peters(k);
        table.rows.push_back({std::to_string(k), std::to_string(peters.samples()), percent(s.samples), percent(s.peters),
                              std::to_string(s.glyphs_short) + " glyphs", percent(peters.enlargement() - 1),
                              shortNumber(s.certified_least), shortNumber(s.certified_median), shortNumber(s.certified_most)});
        paper.points.push_back({static_cast<double>(k), 100 * s.peters, ""});
        certified.points.push_back({static_cast<double>(k), 100 * (s.certified_median - 1), ""});
        margin.points.push_back({static_cast<double>(k), 100 * (peters.enlargement() - 1), ""});
        report.checks.push_back({"k = " + std::to_string(k) + ": certified / exact, least", s.certified_least, ">=", 1});
    }
    plot.curves = {std::move(paper), std::move(certified), std::move(margin)};
    report.tables.push_back(std::move(table));
    report.plots.push_back(std::move(plot));
}

/// Time per glyph of all ways, on one slice, at k = 4 and the slice's own bands.
void addTimes(Report& report, gpu::Device& device, const Options& options) {
    store::Store store(device, {});
    std::string description;
    store.add("slice", slice(options, 8, kSliceGlyphs, description));
    const auto dataset = store.glyphs("slice");
    const model::ShImage& image = dataset->image();
    // A CPU driver needs 0.1 to 1 ms for a glyph.
    const std::size_t glyphs = device.info().software ? std::min<std::size_t>(image.voxels.size(), 1000) : image.voxels.size();
    const std::size_t stride = image.layout.count();
    const double all = static_cast<double>(image.voxels.size()) / static_cast<double>(glyphs);
    report.notes.push_back("Times of the paper's way and of the device from " + std::to_string(glyphs) + " of " +
                           std::to_string(image.voxels.size()) +
                           " glyphs; those of all are extrapolated from them. Certified on the CPU: all glyphs.");
    std::vector<std::uint32_t> slots(glyphs);
    std::iota(slots.begin(), slots.end(), 0U);
    render::Renderer renderer(device, store);
    model::FrameRequest request = requestOf("slice", kFrameHeight * 16 / 9, kFrameHeight, true);
    request.quality.traversal = model::Traversal::kAuto;
    request.scene.layers[0].glyphs().lmax = 4;
    request.camera =
        renderer.fitCamera("slice", request.scene.layers[0].glyphs().selection, model::Convention::kRadiological, 16.0 / 9);
    Table table{"time, " + description, {"k", "way", "us per glyph", "all glyphs, ms (extrapolated)", "paper"}, {}};
    for (const int k : {4, image.layout.lmax}) {
        const ShLayout layout{k, false};
        std::vector<float> cut(image.voxels.size() * layout.count());
        for (std::size_t g = 0; g < image.voxels.size(); ++g) {
            std::copy_n(image.coefficients.begin() + static_cast<std::ptrdiff_t>(g * stride), layout.count(),
                        cut.begin() + static_cast<std::ptrdiff_t>(g * layout.count()));
        }
        const PetersBoxes peters(k);
        const BoundsEvaluator evaluator(layout);
        store::DeviceBounds on_device(device, layout);
        std::vector<GlyphBounds> bounds(image.voxels.size());
        Series paper{"paper's boxes, all CPU threads", "ms", {}}, cpu{"certified, all CPU threads", "ms", {}},
            gpu{"certified, device", "ms", {}}, frame{"frame of these glyphs at k = 4", "ms", {}};
        render::Target target;
        interleave(report.repeats,
                   {[&] {
                        paper.values.push_back(millisecondsOf([&] {
                            parallelFor(glyphs, 16, [&](std::size_t begin, std::size_t end) {
                                for (std::size_t g = begin; g < end; ++g) {
                                    peters.box(std::span(cut).subspan(g * layout.count(), layout.count()), false);
                                }
                            });
                        }));
                    },
                    [&] { cpu.values.push_back(millisecondsOf([&] { evaluator.evaluate(cut, true, bounds); })); },
                    [&] {
                        on_device.evaluate(dataset->coefficients(), image.coefficients, stride, slots, true);
                        gpu.values.push_back(on_device.timeMs());
                    },
                    [&] { frame.values.push_back(passTime(renderer.render(target, request, 0, 1).info, {})); }});
        for (const Series* series : {&paper, &cpu, &gpu}) {
            const double of_all = series->median() * (series == &cpu ? 1 : all);
            table.rows.push_back({std::to_string(k), series->name,
                                  shortNumber(1000 * of_all / static_cast<double>(image.voxels.size())), shortNumber(of_all),
                                  series == &paper && k == 4 ? "29 us, one thread" : ""});
        }
        if (k == 4) {
            table.rows.push_back({"4", frame.name + ", 1280x720", "", shortNumber(frame.median()), ""});
            // With uncertainty there are two boxes per glyph.
            report.checks.push_back({"2 boxes per glyph by the faster way / one frame (k = 4)",
                                     2 * std::min(cpu.median(), all * gpu.median()) / frame.median(), "<=", 3});
        }
        for (Series* series : {&paper, &cpu, &gpu, &frame}) {
            series->name = "k = " + std::to_string(k) + ", " + series->name;
            report.series.push_back(*series);
        }
    }
    report.scene += "; " + description;
    report.tables.push_back(std::move(table));
}

}  // namespace

Report petersBounds(gpu::Device& device, const Options& options) {
    Report report;
    report.experiment = "peters-bounds";
    report.repeats = options.rounds(7);
    report.scene = "uniform coefficients for the extents";
    report.view = "none for the boxes; 1280x720, fitted, for the frame";
    report.device = device.info().name + ", " + device.info().driver;
    addShortfalls(report);
    addTimes(report, device, options);
    report.notes.push_back(
        "The paper tested 100,000 glyphs for each k up to 12 against a million samples, found up to 1.9 % (k <= 8) and 3.07 % "
        "missing before the enlargement, and 29 us per glyph on one thread of a Core i7-11700KF. Its basis is tabulated here, "
        "which "
        "makes its search faster than evaluating it anew. The first round of the times is not left out: there is nothing to "
        "warm up.");
    noteShortfalls(report, kFrameHeight, kFrameHeight);
    return report;
}

}  // namespace radiata::lab
