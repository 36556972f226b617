// march-vs-polynomial: first hits by the march, by the march with its pole-frame table, by the polynomial solver of Peters et
// al. 2023 (Algorithm 1) and by the ray marching of van Almsick et al. 2011, one glyph filling the picture; with --image also a
// whole frame of that image, zoomed until its glyphs fill 1280x720. Both lobes are shown, as Peters' glyph is |f|.
// Every ratio is taken against the fastest setting of the other method that draws no wrong pixel.
#include <algorithm>

#include "gpu/device.h"
#include "tools/lab/comparison.h"
#include "tools/lab/experiments.h"
#include "tools/lab/scenes.h"

namespace radiata::lab {
namespace {

constexpr int kSize = 256;
constexpr int kReferencePixels = 4096;

struct Band {
    int k;
    double march, table;  ///< times as fast as the polynomial at its best setting
};
constexpr Band kBands[] = {{4, 4, 8}, {8, 3.5, 20}, {12, 9, 60}};

void compareBand(render::Renderer& renderer, store::Store& store, const Band& band, int size, Report& report) {
    const std::string id = "k" + std::to_string(band.k), view = "k = " + std::to_string(band.k);
    store.add(id, oneGlyph({band.k, false}, fibreLobes(band.k)));
    const model::FrameRequest request = filledRequest(store, id, size);
    std::vector<Method> methods = glyphMethods({band.k, false}, {"march", "polynomial,"});
    if (band.k == 4) {
        for (const bool per_ray : {true, false}) {
            methods.push_back(rayMarch(model::Intersection::kRayMarchVanAlmsick, 200, per_ray));
        }
    }
    const Comparison comparison =
        compareMethods(report, renderer, store, view, candidatesOf(request, methods), request, kReferencePixels);
    const double polynomial = comparison.medianMs(comparison.best("polynomial"));
    report.checks.push_back(
        {view + ": polynomial at its best / march", polynomial / comparison.medianMs("march"), ">=", band.march});
    report.checks.push_back({view + ": polynomial at its best / march with table",
                             polynomial / comparison.medianMs("march, pole table"), ">=", band.table});
    if (band.k == 4) {
        // Its cylinder bounds what it marches through; the boxes that rays meet first are the same for all.
        const double march = comparison.medianMs("march");
        report.checks.push_back({view + ": van Almsick, 200 steps, rotated per ray / march",
                                 comparison.medianMs("ray-march-van-almsick, 200 steps, rotated per ray") / march, ">=", 10});
        report.checks.push_back({view + ": van Almsick, 200 steps, rotated once / march",
                                 comparison.medianMs("ray-march-van-almsick, 200 steps") / march, ">=", 10});
    }
    for (const char* name : {"march", "march, pole table"}) {
        report.checks.push_back(
            {view + ": wrong pixels, " + name, static_cast<double>(comparison.errorsOf(name).wrong), "<=", 0});
    }
}

/// A dense slice seen so near that glyphs fill the picture: eight voxels high.
void compareFrame(render::Renderer& renderer, store::Store& store, const Options& options, Report& report) {
    std::string description;
    store.add("image", slice(options, 8, 0, description));
    const model::DatasetInfo info = store.info("image");
    report.scene += "; " + description;
    model::FrameRequest request = requestOf("image", 1280, 720, true);
    request.quality.traversal = model::Traversal::kAuto;
    request.camera =
        renderer.fitCamera("image", request.scene.layers[0].glyphs().selection, model::Convention::kRadiological, 1280.0 / 720);
    request.camera.height_mm = 8 * glm::length(glm::dvec3(info.voxel_to_world[0]));
    const std::string view = "whole frame, " + description;
    std::vector<Method> methods = glyphMethods(info.layout, {"march", "polynomial,"});
    const Comparison comparison =
        compareMethods(report, renderer, store, view, candidatesOf(request, methods), request, kReferencePixels);
    std::vector<double> march;
    for (const Measured& measured : comparison.measured) {
        if (measured.family == "march") march.push_back(measured.frame_time.median());
    }
    const double polynomial = comparison.measured[comparison.best("polynomial")].frame_time.median();
    const double bound = info.layout.lmax <= 4 ? 1.5 : 3;
    report.checks.push_back({"whole frame: polynomial at its best / march",
                             polynomial / *std::min_element(march.begin(), march.end()), ">=", bound});
}

}  // namespace

Report marchVersusPolynomial(gpu::Device& device, const Options& options) {
    Report report;
    report.experiment = "march-vs-polynomial";
    report.scene = "one glyph of three crossing lobes, both signs shown";
    const int size = options.size > 0 ? options.size : kSize;
    report.view = std::to_string(size) + "x" + std::to_string(size) + ", orthographic, filled";
    report.repeats = options.rounds();
    store::Store store(device, {});
    render::Renderer renderer(device, store);
    report.device = renderer.deviceName();
    for (const Band& band : kBands) compareBand(renderer, store, band, size, report);
    if (!options.image.empty()) compareFrame(renderer, store, options, report);
    report.notes.push_back(comparisonNote());
    noteShortfalls(report, size, kSize);
    return report;
}

}  // namespace radiata::lab
