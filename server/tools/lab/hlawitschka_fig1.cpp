// hlawitschka-fig1: two glyphs, the second the first one slightly tilted, by
// tensor-march with each step and refinement, by interval and reduced affine
// arithmetic on the tensor, and by the march: time against error. Both lobes
// are shown. The paper finds that no refinement helps what the steps have
// missed, and that one interpolation does better than two bisections. Source:
// Hlawitschka et al., Fig. 1 and Sec. 4, 5.
#include "gpu/device.h"
#include "tools/lab/comparison.h"
#include "tools/lab/experiments.h"
#include "tools/lab/scenes.h"
#include "tools/lab/tensor_scenes.h"

namespace radiata::lab {
namespace {

constexpr int kPaperSize = 600, kReducedSize = 128;
constexpr int kReferencePixels = 2000;

}  // namespace

Report hlawitschkaFig1(gpu::Device& device, const Options& options) {
    Report report;
    report.experiment = "hlawitschka-fig1";
    report.repeats = options.rounds(15);
    const int size = pictureHeight(device, options, kPaperSize, kReducedSize);
    report.scene =
        "one sharpened glyph of order 4 and the same tilted by 0.1 "
        "radians, both signs shown";
    report.view = std::to_string(size) + "x" + std::to_string(size) + ", orthographic, filled";
    store::Store store(device, {});
    render::Renderer renderer(device, store);
    report.device = renderer.deviceName();
    const std::vector<float> glyph = sharpenedLobes(4);
    store.add("left", tensorImage(4, {glyph}));
    store.add("right", tensorImage(4, {turned(4, glyph, {1, 0.4, 0}, 0.1)}));
    for (const std::string id : {"left", "right"}) {
        const model::FrameRequest request = filledRequest(store, id, size);
        std::vector<Method> methods = glyphMethods({4, false}, {"march"});
        for (const Method& method : tensorMarches(false)) methods.push_back(method);
        for (const Method& method : tensorRanges()) methods.push_back(method);
        const std::string view = id + " glyph";
        const Comparison comparison =
            compareMethods(report, renderer, store, view, candidatesOf(request, methods), request, kReferencePixels);
        const auto p50 = [&](const std::string& how) {
            return comparison.errorsOf("tensor-march, step 0.02, " + how).depth_p50;
        };
        report.checks.push_back({view + ": depth p50 of interpolation / two bisections, step 0.02",
                                 p50("interpolation") / p50("bisect 2"), "<=", 1});
        report.checks.push_back({view + ": interval / affine time",
                                 comparison.medianMs("tensor-interval") / comparison.medianMs("tensor-affine"), ">=", 1});
        report.checks.push_back(
            {view + ": wrong pixels of the march", static_cast<double>(comparison.errorsOf("march").wrong), "<=", 0});
    }
    report.notes.push_back(
        "The paper's glyphs are not at hand. It says that affine arithmetic is "
        "up to five times faster than intervals.");
    report.notes.push_back(comparisonNote());
    noteShortfalls(report, size, kReducedSize);
    return report;
}

}  // namespace radiata::lab
