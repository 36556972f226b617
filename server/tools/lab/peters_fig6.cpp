// peters-fig6: what a number of steps does to small features: van Almsick's ray marching with 50 to 400 steps, Peeters' too,
// the polynomial and the march, at k = 4 on one glyph and on its smaller lobes. Both lobes are shown. Source: Peters et al.
// 2023, Fig. 6 and Sec. 5.1: 100 steps leave clear artefacts, 200 negligible ones.
#include "gpu/device.h"
#include "tools/lab/comparison.h"
#include "tools/lab/experiments.h"
#include "tools/lab/scenes.h"

namespace radiata::lab {
namespace {

constexpr int kPaperSize = 1080, kReducedSize = 160;
constexpr int kReferencePixels = 3000;

}  // namespace

Report petersFig6(gpu::Device& device, const Options& options) {
    Report report;
    report.experiment = "peters-fig6";
    report.repeats = options.rounds(15);
    const int size = pictureHeight(device, options, kPaperSize, kReducedSize);
    report.scene = "one sharpened glyph of three lobes, k = 4, both signs shown";
    report.view =
        std::to_string(size) + "x" + std::to_string(size) + ", orthographic: the whole glyph, and a fifth of it at the centre";
    store::Store store(device, {});
    render::Renderer renderer(device, store);
    report.device = renderer.deviceName();
    store.add("glyph", oneGlyph({4, false}, sharpenedLobes(4)));
    std::vector<Method> methods = glyphMethods({4, false}, {"march", "polynomial", "laguerre"});
    for (const int steps : {50, 100, 200, 400}) {
        methods.push_back(rayMarch(model::Intersection::kRayMarchVanAlmsick, steps, true));
        methods.push_back(rayMarch(model::Intersection::kRayMarchVanAlmsick, steps, false));
        methods.push_back(rayMarch(model::Intersection::kRayMarchPeeters, steps, false));
    }
    for (const double zoom : {1.0, 0.2}) {
        const std::string view = zoom < 1 ? "centre" : "whole";
        const model::FrameRequest request = filledRequest(store, "glyph", size, zoom);
        const Comparison comparison =
            compareMethods(report, renderer, store, view, candidatesOf(request, methods), request, kReferencePixels);
        const auto wrong = [&](int steps) {
            return comparison.errorsOf(rayMarch(model::Intersection::kRayMarchVanAlmsick, steps, true).name).wrong;
        };
        report.checks.push_back({view + ": wrong pixels of 200 steps - of 100 steps",
                                 static_cast<double>(wrong(200)) - static_cast<double>(wrong(100)), "<=", 0});
        report.checks.push_back(
            {view + ": wrong pixels of the march", static_cast<double>(comparison.errorsOf("march").wrong), "<=", 0});
    }
    report.notes.push_back("The paper's dataset is not at hand.");
    report.notes.push_back(comparisonNote());
    noteShortfalls(report, size, kReducedSize);
    return report;
}

}  // namespace radiata::lab
