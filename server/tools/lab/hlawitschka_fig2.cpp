// hlawitschka-fig2: the gap at the centre of a sharpened glyph and what closes
// it: coarse steps alone, an isotropic part added to the glyph, steps of a
// third near the centre (base steps 0.02 and 0.05), and the march, which has no
// steps of its own. Missed pixels are counted in the picture of the whole glyph
// and in a close-up of its centre. Source: Hlawitschka et al., Fig. 2 and Sec.
// 4: from 18 to 15 frames per second by adaptive steps. Its caption gives steps
// of 0.2 and 0.5, which cannot be: its Fig. 1 and Table 1 use 0.02 and 0.05.
#include <cmath>
#include <numbers>

#include "gpu/device.h"
#include "tools/lab/comparison.h"
#include "tools/lab/experiments.h"
#include "tools/lab/scenes.h"
#include "tools/lab/tensor_scenes.h"

namespace radiata::lab {
namespace {

constexpr int kPaperSize = 600, kReducedSize = 128;
constexpr int kReferencePixels = 2000;
constexpr double kIsotropic = 0.15;  // amplitudes

}  // namespace

Report hlawitschkaFig2(gpu::Device& device, const Options& options) {
    Report report;
    report.experiment = "hlawitschka-fig2";
    report.repeats = options.rounds(15);
    const int size = pictureHeight(device, options, kPaperSize, kReducedSize);
    report.scene =
        "one sharpened glyph of order 4, as it is and with an "
        "isotropic part of " +
        shortNumber(kIsotropic) + " added";
    report.view =
        std::to_string(size) + "x" + std::to_string(size) + ", orthographic: the whole glyph, and a tenth of it at the centre";
    store::Store store(device, {});
    render::Renderer renderer(device, store);
    report.device = renderer.deviceName();
    const std::vector<float> glyph = sharpenedLobes(4);
    std::vector<float> rounder = glyph;
    rounder[0] += static_cast<float>(kIsotropic * std::sqrt(4 * std::numbers::pi));
    store.add("glyph", tensorImage(4, {glyph}));
    store.add("rounder", tensorImage(4, {rounder}));
    Table summary{"missed pixels of those with a hit, and time",
                  {"glyph", "method", "whole: missed", "wrong", "ms", "centre: missed", "wrong", "ms"},
                  {}};
    for (const std::string id : {"glyph", "rounder"}) {
        std::vector<Method> methods = glyphMethods({4, false}, {"march"});
        for (const bool adaptive : {false, true}) {
            for (const Method& method : tensorMarches(adaptive)) {
                if (method.name.find("interpolation") != std::string::npos && method.name.find("0.01") == std::string::npos)
                    methods.push_back(method);
            }
        }
        const std::string name = id == "glyph" ? "as it is" : "with isotropic part";
        std::vector<Comparison> views;
        for (const double zoom : {1.0, 0.1}) {
            const model::FrameRequest request = filledRequest(store, id, size, zoom);
            views.push_back(compareMethods(report, renderer, store, name + (zoom < 1 ? ", centre" : ", whole"),
                                           candidatesOf(request, methods), request, kReferencePixels));
        }
        for (std::size_t i = 0; i < methods.size(); ++i) {
            std::vector<std::string> row{name, methods[i].name};
            for (const Comparison& view : views) {
                row.push_back(std::to_string(view.errors[i].missed));
                row.push_back(std::to_string(view.errors[i].wrong));
                row.push_back(shortNumber(view.medianMs(i)));
            }
            summary.rows.push_back(std::move(row));
        }
        const std::string coarse = "tensor-march, step 0.05, interpolation";
        report.checks.push_back({name + ", centre: wrong pixels by adaptive steps / without",
                                 static_cast<double>(views[1].errorsOf(coarse + ", adaptive").wrong) /
                                     std::max(1.0, static_cast<double>(views[1].errorsOf(coarse).wrong)),
                                 "<=", 1});
        report.checks.push_back({name + ": wrong pixels of the march",
                                 static_cast<double>(views[0].errorsOf("march").wrong + views[1].errorsOf("march").wrong),
                                 "<=", 0});
    }
    report.tables.insert(report.tables.begin(), std::move(summary));
    report.notes.push_back(
        "The paper's glyph is not at hand. An isotropic part can also be asked "
        "for in a scene, and changes what is shown.");
    report.notes.push_back(comparisonNote());
    noteShortfalls(report, size, kReducedSize);
    return report;
}

}  // namespace radiata::lab
