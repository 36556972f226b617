// glyph-frame: one whole frame of about 20,000 glyphs, fitted to the view's height, all passes, no encoding.
#include <chrono>
#include <filesystem>

#include "build/phantom.h"
#include "io/sh_image.h"
#include "render/frame/renderer.h"
#include "store/store.h"
#include "tools/lab/experiments.h"
#include "tools/lab/measure.h"

namespace radiata::lab {
namespace {

constexpr std::uint64_t kGlyphsWanted = 20'000;

model::ShImage loadScene(const Options& options, std::string& description) {
    if (!options.image.empty()) {
        model::ShImage image = io::readShImage(options.image);
        description = std::filesystem::path(options.image).filename().string();
        return image;
    }
    PhantomOptions phantom;
    phantom.slice_glyphs = kGlyphsWanted;
    phantom.lmax = 8;
    description = "phantom slice, seed " + std::to_string(phantom.seed);
    return phantomShImage(phantom);
}

struct Variant {
    std::string name;
    model::Traversal traversal;
    model::PoleTable table;
};

}  // namespace

Report glyphFrame(gpu::Device& device, const Options& options) {
    Report report;
    report.experiment = "glyph-frame";
    report.repeats = options.rounds();
    store::Store store(device, {});
    model::ShImage image = loadScene(options, report.scene);
    const std::uint64_t glyphs = image.voxels.size();
    report.scene += ", " + std::to_string(glyphs) + " glyphs, lmax " + std::to_string(image.layout.lmax);
    store.add("scene", std::move(image));
    render::Renderer renderer(device, store);
    report.device = renderer.deviceName();

    model::FrameRequest request;
    request.height = options.size > 0 ? options.size : 720;
    request.width = request.height * 16 / 9;
    request.quality.samples = 1;
    request.scene.annotations.hidden = true;
    model::Layer layer;
    layer.glyphs().dataset_id = "scene";
    layer.glyphs().selection.region = model::Region::kVolume;
    request.scene.layers = {layer};
    request.camera = renderer.fitCamera("scene", layer.glyphs().selection, model::Convention::kRadiological,
                                        static_cast<double>(request.width) / request.height);
    report.view =
        std::to_string(request.width) + "x" + std::to_string(request.height) + ", axial, fitted, one sample per pixel";

    std::vector<Variant> variants = {{"auto", model::Traversal::kAuto, model::PoleTable::kAuto}};
    for (const std::string& name : renderer.traversals()) {
        const model::Traversal traversal = name == "ray_query"      ? model::Traversal::kRayQuery
                                           : name == "bvh"          ? model::Traversal::kBvh
                                           : name == "raster_boxes" ? model::Traversal::kRasterBoxes
                                                                    : model::Traversal::kTiles;
        variants.push_back({name + ", table", traversal, model::PoleTable::kOn});
        variants.push_back({name + ", direct", traversal, model::PoleTable::kOff});
    }
    std::vector<render::Target> targets(variants.size());
    std::vector<Series> glyph(variants.size()), boxes(variants.size()), frame(variants.size());
    std::vector<std::function<void()>> measurements;
    bool warm = false;
    std::string chosen;
    std::uint64_t capped = 0;
    for (std::size_t i = 0; i < variants.size(); ++i) {
        glyph[i] = {variants[i].name + ": glyph passes", "ms", {}};
        boxes[i] = {variants[i].name + ": same boxes only", "ms", {}};
        frame[i] = {variants[i].name + ": whole frame, wall clock", "ms", {}};
        measurements.push_back([&, i] {
            model::FrameRequest own = request;
            own.quality.traversal = variants[i].traversal;
            own.quality.pole_table = variants[i].table;
            const model::Frame result = renderer.render(targets[i], own, 0, 1);
            const double box_ms = renderer.measureBoxes(targets[i], own);
            capped += result.info.capped_rays;
            if (i == 0) chosen = "auto chose " + result.info.traversal_reason + "; pole table " + result.info.pole_table_reason;
            if (!warm) return;
            glyph[i].values.push_back(passTime(result.info, {"glyph"}));
            boxes[i].values.push_back(box_ms);
            frame[i].values.push_back(result.info.render_ms);
        });
    }
    interleave(1, measurements);
    warm = true;
    interleave(report.repeats, measurements);
    for (std::size_t i = 0; i < variants.size(); ++i) {
        for (Series* series : {&frame[i], &glyph[i], &boxes[i]}) report.series.push_back(*series);
    }
    report.plots.push_back(
        {"finding boxes against the whole of it", "same boxes only, ms", "glyph passes, ms", false, false, false, {}});
    for (std::size_t i = 0; i < variants.size(); ++i) {
        const PlotPoint point{boxes[i].median(), glyph[i].median(), variants[i].name};
        report.plots.back().curves.push_back({variants[i].name, {point}, false});
    }
    report.notes.push_back(chosen);
    report.checks.push_back({"glyph pass / same boxes (auto)", glyph[0].median() / boxes[0].median(), "<=", 2.5});
    report.checks.push_back({"capped rays", static_cast<double>(capped), "<=", 0});
    if (glyphs < kGlyphsWanted) report.shortfalls.push_back(std::to_string(glyphs) + " glyphs; 20,000 are asked for");
    noteShortfalls(report, request.height, 720);
    return report;
}

}  // namespace radiata::lab
