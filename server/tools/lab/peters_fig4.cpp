// peters-fig4: what shadows cost. The scene without, with hard, with soft shadows of 16 rays and with ambient occlusion, as in
// Peters et al. 2023, Figure 4 (one glyph that shadows itself) and in the shadow rows of its Table 1 (a slice of 19,600 glyphs,
// all of which shadow each other). Times of each effect are its own passes and what it adds to the light pass, over the glyph
// passes of the same frame.
#include <algorithm>

#include "gpu/device.h"
#include "tools/lab/experiments.h"
#include "tools/lab/measure.h"
#include "tools/lab/scenes.h"

namespace radiata::lab {
namespace {

constexpr int kHeight = 720;
constexpr std::uint64_t kGlyphs = 19'600;

std::vector<Candidate> kinds(const model::FrameRequest& request) {
    std::vector<Candidate> all;
    const auto add = [&](const std::string& name, auto change) {
        Candidate candidate{name, "march", request};
        change(candidate.request);
        all.push_back(candidate);
    };
    add("no shadow", [](model::FrameRequest&) {});
    add("hard shadow, sun table", [](model::FrameRequest& r) {
        r.scene.light.shadow = model::Shadow::kHard;
        r.quality.sun_table = model::PoleTable::kOn;
    });
    add("hard shadow, direct", [](model::FrameRequest& r) {
        r.scene.light.shadow = model::Shadow::kHard;
        r.quality.sun_table = model::PoleTable::kOff;
    });
    add("hard shadow, auto", [](model::FrameRequest& r) { r.scene.light.shadow = model::Shadow::kHard; });
    add("soft shadow, 16 rays", [](model::FrameRequest& r) { r.scene.light.shadow = model::Shadow::kSoft; });
    add("ambient occlusion, 16 rays",
        [](model::FrameRequest& r) { r.scene.light.ambient_occlusion = model::AmbientOcclusion{}; });
    return all;
}

/// GPU ms of the effect's own passes with the light pass, round by round over the glyph passes of the same round.
double addedShare(const Measured& effect, const Measured& plain) {
    Series share;
    const std::size_t rounds = std::min(effect.time.values.size(), plain.time.values.size());
    for (std::size_t i = 0; i < rounds; ++i) {
        // time: glyph passes; frame_time: all.
        const double rest = effect.frame_time.values[i] - effect.time.values[i];
        const double plain_rest = plain.frame_time.values[i] - plain.time.values[i];
        share.values.push_back((rest - plain_rest) / plain.time.values[i]);
    }
    return share.median();
}

/// All passes of a frame over the rays that each pixel of it sends on from its glyph.
Plot raysPlot(const std::string& view, const std::vector<Measured>& measured) {
    Plot plot{view, "rays on from each pixel's glyph", "all passes, ms", true, false, false, {}};
    for (const Measured& kind : measured) {
        const double rays = kind.name.ends_with("16 rays") ? 16 : kind.name.starts_with("hard") ? 1 : 0;
        plot.curves.push_back({kind.name, {{rays, kind.frame_time.median(), kind.name}}, false});
    }
    return plot;
}

void compareKinds(Report& report, render::Renderer& renderer, const std::string& view, const model::FrameRequest& request,
                  int repeats, bool judged) {
    const std::vector<Measured> measured = measure(renderer, kinds(request), repeats);
    Table table{view, {"", "glyph passes, ms", "spread", "all passes, ms", "spread", "effect / glyph passes"}, {}};
    const auto percent = [](double share) { return shortNumber(100 * share) + " %"; };
    for (const Measured& kind : measured) {
        const bool plain = &kind == &measured.front();
        table.rows.push_back({kind.name, shortNumber(kind.time.median()), percent(kind.time.spread()),
                              shortNumber(kind.frame_time.median()), percent(kind.frame_time.spread()),
                              plain ? "" : percent(addedShare(kind, measured.front()))});
    }
    report.tables.push_back(table);
    report.plots.push_back(raysPlot(view, measured));
    for (const Measured& kind : measured) {
        if (kind.name == "hard shadow, auto") report.notes.push_back(view + ": sun table " + kind.info.sun_table_reason);
        if (!judged) continue;
        const double share = addedShare(kind, measured.front());
        if (kind.name == "hard shadow, auto")
            report.checks.push_back({view + ": hard shadow / glyph passes", share, "<=", 0.8});
        if (kind.name.starts_with("soft")) report.checks.push_back({view + ": soft shadow / glyph passes", share, "<=", 10});
    }
}

}  // namespace

Report petersFig4(gpu::Device& device, const Options& options) {
    Report report;
    report.experiment = "peters-fig4";
    report.repeats = options.rounds(7);
    const int height = options.size > 0 ? options.size : kHeight;
    report.view = std::to_string(height * 16 / 9) + "x" + std::to_string(height) + ", one sample per pixel";
    store::Store store(device, {});
    render::Renderer renderer(device, store);
    report.device = renderer.deviceName();

    std::string description;
    Options own = options;
    store.add("slice", slice(own, 4, kGlyphs, description));
    store.add("glyph", oneGlyph({8, false}, fibreLobes(8)));
    report.scene = description + "; one glyph of three crossing lobes, band 8";
    model::FrameRequest request = requestOf("slice", height * 16 / 9, height, false);
    request.quality.traversal = model::Traversal::kAuto;
    request.camera = renderer.fitCamera("slice", request.scene.layers[0].glyphs().selection, model::Convention::kRadiological,
                                        static_cast<double>(request.width) / request.height);
    compareKinds(report, renderer, "slice", request, report.repeats, true);
    model::FrameRequest near = request;
    near.camera.height_mm /= 6;
    compareKinds(report, renderer, "slice, six times nearer", near, report.repeats, true);
    model::FrameRequest one = filledRequest(store, "glyph", height);
    one.quality.traversal = model::Traversal::kAuto;
    compareKinds(report, renderer, "one glyph", one, report.repeats, false);
    report.notes.emplace_back(
        "effect: its own passes and what it adds to the light pass; the papers' own data are not at hand, so a phantom or the "
        "image given stands for their slice");
    noteShortfalls(report, height, kHeight);
    return report;
}

}  // namespace radiata::lab
