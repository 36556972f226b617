// glyph-pareto: one glyph filling the picture and a close-up of its centre, by every method and setting: what accuracy costs in
// time. Both lobes are shown, as the glyph of Peters et al. 2023 is |f|.
#include "gpu/device.h"
#include "tools/lab/comparison.h"
#include "tools/lab/experiments.h"
#include "tools/lab/scenes.h"

namespace radiata::lab {
namespace {

constexpr int kPaperSize = 1440, kReducedSize = 192;
constexpr int kReferencePixels = 3000;

}  // namespace

Report glyphPareto(gpu::Device& device, const Options& options) {
    Report report;
    report.experiment = "glyph-pareto";
    report.repeats = options.rounds(15);
    report.scene = "one glyph of three crossing lobes, both signs shown";
    const int size = pictureHeight(device, options, kPaperSize, kReducedSize);
    report.view =
        std::to_string(size) + "x" + std::to_string(size) + ", orthographic: the whole glyph, and 2 % of it at the centre";
    store::Store store(device, {});
    render::Renderer renderer(device, store);
    report.device = renderer.deviceName();
    for (const int k : {4, 8, 12}) {
        const std::string id = "k" + std::to_string(k);
        store.add(id, oneGlyph({k, false}, fibreLobes(k)));
        for (const double zoom : {1.0, 0.02}) {
            const model::FrameRequest request = filledRequest(store, id, size, zoom);
            const std::string view = "k = " + std::to_string(k) + (zoom < 1 ? ", centre" : ", whole");
            const Comparison comparison = compareMethods(
                report, renderer, store, view, candidatesOf(request, glyphMethods({k, false})), request, kReferencePixels);
            report.checks.push_back(
                {view + ": wrong pixels of the march", static_cast<double>(comparison.errorsOf("march").wrong), "<=", 0});
        }
    }
    report.notes.push_back(comparisonNote());
    noteShortfalls(report, size, kReducedSize);
    return report;
}

}  // namespace radiata::lab
