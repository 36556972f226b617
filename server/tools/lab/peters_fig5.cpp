// peters-fig5: a slice of about 19,600 glyphs without and with uncertainty, in whole and in a close-up as the figure shows it,
// at bands 4 (the paper's) and 8: what the second glyphs cost beside the first. They are made by the paper's recipe. Both lobes
// are shown, as Peters' glyph is |f|. In his Table 1 uncertainty takes the frame from 0.59 to 1.93 ms.
#include <algorithm>

#include "build/uncertain_glyphs.h"
#include "render/frame/renderer.h"
#include "tools/lab/experiments.h"
#include "tools/lab/measure.h"
#include "tools/lab/scenes.h"

namespace radiata::lab {
namespace {

constexpr std::uint64_t kGlyphs = 19'600;
constexpr int kHeight = 1080, kReducedHeight = 720;
constexpr double kCloseUp = 0.12;  // share of the fitted view
constexpr double kRatioMax = 3;    // uncertainty against the glyph pass

struct View {
    std::string name;
    model::FrameRequest plain, uncertain;
    Series glyphs, alone, second;  ///< glyph passes with uncertainty in the frame, and without; its own passes
    render::Target plain_target{}, uncertain_target{};
};

View makeView(const std::string& name, const model::FrameRequest& request, model::PoleTable table) {
    View view;
    view.name = name + (table == model::PoleTable::kOn ? ", table" : ", direct");
    view.plain = request;
    view.plain.quality.pole_table = table;
    view.uncertain = view.plain;
    view.uncertain.scene.layers[0].glyphs().uncertainty.emplace().dataset_id = "outer";
    view.alone = {view.name + ": glyph passes, no uncertainty", "ms", {}};
    view.glyphs = {view.name + ": glyph passes", "ms", {}};
    view.second = {view.name + ": uncertainty passes", "ms", {}};
    return view;
}

/// The second glyphs' passes over the first ones'.
void addPoints(const std::vector<View>& views, Plot& plot) {
    for (const View& view : views) {
        const bool close = view.name.find("close-up") != std::string::npos;
        plot.curves[close ? 1 : 0].points.push_back({view.glyphs.median(), view.second.median(), view.name});
    }
}

void runBand(gpu::Device& device, const Options& options, int k, Report& report) {
    std::string description;
    model::ShImage image = slice(options, k, kGlyphs, description);
    report.scene += (report.scene.empty() ? "" : "; ") + description;
    const std::uint64_t glyphs = image.voxels.size();
    store::Store store(device, {});
    store.add("outer", uncertaintyByRecipe(image, {}));
    store.add("mean", std::move(image));
    render::Renderer renderer(device, store);
    report.device = renderer.deviceName();

    const int height = pictureHeight(device, options, kHeight, kReducedHeight), width = height * 16 / 9;
    model::FrameRequest request = requestOf("mean", width, height, true);
    request.quality.traversal = model::Traversal::kAuto;
    request.camera = renderer.fitCamera("mean", request.scene.layers[0].glyphs().selection, model::Convention::kRadiological,
                                        static_cast<double>(width) / height);
    model::FrameRequest close = request;
    close.camera.height_mm *= kCloseUp;
    const std::string prefix = "k = " + std::to_string(k) + ", ";
    std::vector<View> views;
    for (const model::PoleTable table : {model::PoleTable::kOff, model::PoleTable::kOn}) {
        views.push_back(makeView(prefix + "slice", request, table));
        views.push_back(makeView(prefix + "close-up", close, table));
    }
    std::uint64_t capped = 0;
    bool warm = false;
    std::vector<std::function<void()>> measurements;
    for (View& view : views) {
        measurements.push_back([&] {
            const model::FrameInfo plain = renderer.render(view.plain_target, view.plain, 0, 1).info;
            const model::FrameInfo seen = renderer.render(view.uncertain_target, view.uncertain, 0, 1).info;
            capped += seen.capped_rays;
            if (!warm) return;
            view.alone.values.push_back(passTime(plain, {"glyph"}));
            view.glyphs.values.push_back(passTime(seen, {"glyph"}));
            view.second.values.push_back(passTime(seen, {"uncertainty"}));
        });
    }
    interleave(1, measurements);
    warm = true;
    interleave(report.repeats, measurements);
    addPoints(views, report.plots[0]);
    for (const View& view : views) {
        for (const Series* series : {&view.alone, &view.glyphs, &view.second}) report.series.push_back(*series);
        report.checks.push_back(
            {view.name + ": uncertainty / glyph passes", view.second.median() / view.glyphs.median(), "<=", kRatioMax});
    }
    report.checks.push_back({prefix + "capped rays", static_cast<double>(capped), "<=", 0});
    if (glyphs < kGlyphs) report.shortfalls.push_back(std::to_string(glyphs) + " glyphs; 19,600 are asked for");
    report.view = std::to_string(width) + "x" + std::to_string(height) + ", axial, fitted, and a close-up of " +
                  std::to_string(static_cast<int>(100 * kCloseUp)) + " % of it, one sample per pixel";
    if (k == 8) noteShortfalls(report, height, pictureHeight(device, {}, kHeight, kReducedHeight));
}

}  // namespace

Report petersFig5(gpu::Device& device, const Options& options) {
    Report report;
    report.experiment = "peters-fig5";
    report.repeats = options.rounds();
    Plot plot{"second glyphs against the first", "glyph passes, ms", "uncertainty passes, ms", false, false, false, {}};
    plot.curves = {{"slice", {}, false},
                   {"close-up", {}, false},
                   {shortNumber(kRatioMax) + " times the glyph passes: the bound", {{0, 0, {}}}, true}};
    report.plots.push_back(std::move(plot));
    runBand(device, options, 4, report);
    runBand(device, options, 8, report);
    double longest = 0;
    for (const std::size_t curve : {0, 1}) {
        for (const PlotPoint& point : report.plots[0].curves[curve].points) longest = std::max(longest, point.x);
    }
    report.plots[0].curves[2].points.push_back({longest, kRatioMax * longest, {}});
    report.notes.push_back(
        "second glyphs by the recipe of the paper: constant part times 1.7, each coefficient times a variate of mean 1 and "
        "deviation 0.05; the paper's own data are not at hand");
    return report;
}

}  // namespace radiata::lab
