// peters-fig7: a single glyph truncated at bands 2 to 16, 1440x1440 in the paper: time and wrong pixels over the band limit.
// The paper prints 4.42 ms for k = 8 (Arc A770) and times that grow with k^3, and stops at 12 with wrong pixels from 10 on.
// Source: Peters et al. 2023, Fig. 7 and Sec. 5.2, 5.3.
#include <algorithm>
#include <cmath>
#include <random>

#include "base/error.h"
#include "gpu/device.h"
#include "store/glyph_dataset.h"
#include "tools/lab/comparison.h"
#include "tools/lab/experiments.h"
#include "tools/lab/scenes.h"

namespace radiata::lab {
namespace {

constexpr int kPaperSize = 1440, kReducedSize = 160;
constexpr int kReferencePixels = 1200;

/// As the paper: measured bands as far as there are any (an image's glyph with the largest highest band), the bands beyond
/// made of zero-mean Gaussian noise that falls as the measured ones do. Without an image all is made: lobes and noise.
std::vector<float> coefficientsOf(const Options& options, std::string& description) {
    const ShLayout layout{16, false};
    std::vector<float> glyph = fibreLobes(16);
    int measured = 0;
    if (!options.image.empty()) {
        const model::ShImage image = slice(options, 8, 0, description);
        const std::size_t count = image.layout.count();
        if (image.layout.full) throw Error(Code::kInvalidArgument, "peters-fig7: --image must have even bands only");
        const auto power = [&](std::size_t voxel) {
            double sum = 0;
            for (std::size_t i = 1; i < count; ++i)
                sum += std::pow(static_cast<double>(image.coefficients[voxel * count + i]), 2);
            return sum;
        };
        std::size_t strongest = 0;
        for (std::size_t voxel = 1; voxel < image.voxels.size(); ++voxel) {
            if (power(voxel) > power(strongest)) strongest = voxel;
        }
        measured = image.layout.lmax;
        std::copy_n(image.coefficients.begin() + static_cast<std::ptrdiff_t>(strongest * count), count, glyph.begin());
        description =
            "the glyph of strongest contrast of " + description + "; bands above " + std::to_string(measured) + " of noise";
    } else {
        description = "three crossing lobes; bands above 8 with added noise";
        measured = 8;
    }
    std::mt19937 random(7);
    const float size = std::abs(glyph[0]);
    for (int l = measured + 2; l <= 16; l += 2) {
        for (int m = -l; m <= l; ++m) {
            // A sum of twelve uniform numbers is normal enough, and the same everywhere.
            double normal = -6;
            for (int i = 0; i < 12; ++i) normal += static_cast<double>(random()) / 4294967296.0;
            float& c = glyph[layout.index(l, m)];
            if (!options.image.empty()) c = 0;
            c += static_cast<float>(0.05 * static_cast<double>(size) * normal * std::exp(-0.008 * l * (l + 1)));
        }
    }
    return glyph;
}

}  // namespace

Report petersFig7(gpu::Device& device, const Options& options) {
    Report report;
    report.experiment = "peters-fig7";
    report.repeats = options.rounds(15);
    const std::vector<float> glyph = coefficientsOf(options, report.scene);
    const int size = pictureHeight(device, options, kPaperSize, kReducedSize);
    report.view = std::to_string(size) + "x" + std::to_string(size) + ", orthographic, filled; the paper: 1440x1440";
    store::Store store(device, {});
    store.add("glyph", oneGlyph({16, false}, glyph));
    render::Renderer renderer(device, store);
    report.device = renderer.deviceName();
    const double pixels = static_cast<double>(kPaperSize) * kPaperSize / (static_cast<double>(size) * size);
    Table summary{"time over the band limit",
                  {"k", "march", "march with table", "polynomial at its best", "its wrong px", "paper's stop", "its wrong px",
                   "paper (A770)"},
                  {}};
    Plot time{"time over the band limit",
              "k",
              "glyph passes, ms at " + std::to_string(size) + " x " + std::to_string(size),
              false,
              true,
              false,
              {}};
    Plot wrong{"wrong pixels over the band limit", "k", "share of wrong pixels", false, true, false, {}};
    const char* names[] = {"march", "march, pole table", "polynomial, bracket stop", "polynomial, paper's stop"};
    for (const char* name : names) {
        time.curves.push_back({name, {}, true});
        wrong.curves.push_back({name, {}, true});
    }
    for (int k = 2; k <= 16; k += 2) {
        model::FrameRequest request = filledRequest(store, "glyph", size);
        request.scene.layers[0].glyphs().lmax = k;
        request.camera.height_mm =
            2 * static_cast<double>(store.glyphs("glyph")->bounds(std::vector<std::uint32_t>{0}, k, true)[0].radius);
        const std::vector<Method> methods =
            k <= 12 ? glyphMethods({k, false}, {"march", "polynomial,"}) : glyphMethods({k, false}, {"march"});
        const std::string view = "k = " + std::to_string(k);
        const Comparison comparison =
            compareMethods(report, renderer, store, view, candidatesOf(request, methods), request, kReferencePixels);
        const auto ms = [&](const std::string& name) {
            return comparison.has(name) ? shortNumber(comparison.medianMs(name)) : "-";
        };
        const auto bad = [&](const std::string& name) {
            return comparison.has(name) ? std::to_string(comparison.errorsOf(name).wrong) : "-";
        };
        const std::string best = k <= 12 ? comparison.measured[comparison.best("polynomial")].name : "";
        summary.rows.push_back({std::to_string(k), ms(names[0]), ms(names[1]), ms(best), bad(best), ms(names[3]), bad(names[3]),
                                k == 8 ? "4.42" : ""});
        for (std::size_t i = 0; i < std::size(names); ++i) {
            if (!comparison.has(names[i])) continue;
            time.curves[i].points.push_back({static_cast<double>(k), comparison.medianMs(names[i]), ""});
            wrong.curves[i].points.push_back({static_cast<double>(k), comparison.errorsOf(names[i]).wrong_share, ""});
        }
        report.checks.push_back(
            {view + ": wrong pixels of the march", static_cast<double>(comparison.errorsOf("march").wrong), "<=", 0});
    }
    report.tables.insert(report.tables.begin(), summary);
    report.plots.insert(report.plots.begin(), {time, wrong});
    report.notes.push_back("The paper's dataset is not at hand. Times in ms; at 1440x1440 they are " + shortNumber(pixels) +
                           " times these (extrapolated by pixels). The paper's 4.42 ms were measured on an Arc A770.");
    report.notes.push_back(comparisonNote());
    noteShortfalls(report, size, kReducedSize);
    return report;
}

}  // namespace radiata::lab
