// peters-table1: a slice of 19,600 glyphs at k = 4 by van Almsick's ray marching (100 and 200 steps, coefficients rotated for
// each ray or once for the camera), by Peters' polynomial and by the march, in boxes around van Almsick's cylinder and in tight
// boxes; and the march with uncertainty and shadows. Both lobes are shown, as Peters' glyph is |f|. Source: Peters et al. 2023,
// Table 1 (1920x1080, Arc A770); its rows are shifted in print: "Ours" is 0.95 ms with the cylinder's boxes and 0.59 ms with
// tight ones.
#include "build/uncertain_glyphs.h"
#include "gpu/device.h"
#include "tools/lab/comparison.h"
#include "tools/lab/experiments.h"
#include "tools/lab/scenes.h"

namespace radiata::lab {
namespace {

constexpr int kPaperHeight = 1080, kReducedHeight = 360;
constexpr std::uint64_t kGlyphs = 19'600;
constexpr int kReferencePixels = 1500;

struct Row {
    model::Intersection method;
    int steps;
    bool per_ray;
    double paper_cylinder_ms, paper_tight_ms;
};

const Row kRows[] = {
    {model::Intersection::kRayMarchVanAlmsick, 100, true, 1.55, 0.73},
    {model::Intersection::kRayMarchVanAlmsick, 100, false, 1.13, 0.59},
    {model::Intersection::kRayMarchVanAlmsick, 200, true, 2.23, 1.07},
    {model::Intersection::kRayMarchVanAlmsick, 200, false, 1.80, 0.89},
};

void addMethod(std::vector<Candidate>& candidates, const model::FrameRequest& request, const Method& method,
               model::GlyphBoxes boxes) {
    Candidate candidate{(boxes == model::GlyphBoxes::kTight ? "tight: " : "cylinder: ") + method.name, method.family, request};
    method.set(candidate.request.quality);
    candidate.request.quality.glyph_boxes = boxes;
    candidates.push_back(std::move(candidate));
}

/// What the shading rows of the table add to the glyph passes.
void addEffects(Report& report, render::Renderer& renderer, const model::FrameRequest& request) {
    model::FrameRequest uncertain = request, hard = request;
    uncertain.scene.layers[0].glyphs().uncertainty.emplace().dataset_id = "outer";
    hard.scene.light.shadow = model::Shadow::kHard;
    model::FrameRequest uncertain_hard = uncertain, uncertain_soft = uncertain;
    uncertain_hard.scene.light.shadow = model::Shadow::kHard;
    uncertain_soft.scene.light.shadow = model::Shadow::kSoft;
    const std::vector<Candidate> candidates{{"march", "march", request},
                                            {"march, hard shadows", "march", hard},
                                            {"march, uncertainty", "march", uncertain},
                                            {"march, uncertainty and hard shadows", "march", uncertain_hard},
                                            {"march, uncertainty and soft shadows of 16 rays", "march", uncertain_soft}};
    const std::vector<Measured> measured = measure(renderer, candidates, report.repeats);
    Table table{"whole frames with effects", {"frame", "GPU ms", "of the plain frame", "paper, ms", "of its plain frame"}, {}};
    const char* paper[][2] = {{"0.59", "1"}, {"-", "-"}, {"1.93", "3.27"}, {"2", "3.39"}, {"4.02", "6.81"}};
    for (std::size_t i = 0; i < measured.size(); ++i) {
        const double ms = measured[i].frame_time.median();
        table.rows.push_back(
            {measured[i].name, shortNumber(ms), shortNumber(ms / measured[0].frame_time.median()), paper[i][0], paper[i][1]});
    }
    report.tables.push_back(std::move(table));
}

}  // namespace

Report petersTable1(gpu::Device& device, const Options& options) {
    Report report;
    report.experiment = "peters-table1";
    report.repeats = options.rounds(9);
    const int height = pictureHeight(device, options, kPaperHeight, kReducedHeight), width = height * 16 / 9;
    report.view = std::to_string(width) + "x" + std::to_string(height) + ", axial, fitted; the paper: 1920x1080";
    store::Store store(device, {});
    model::ShImage image = slice(options, 4, kGlyphs, report.scene);
    store.add("outer", uncertaintyByRecipe(image, {}));
    store.add("slice", std::move(image));
    render::Renderer renderer(device, store);
    report.device = renderer.deviceName();
    model::FrameRequest request = requestOf("slice", width, height, true);
    request.scene.layers[0].glyphs().lmax = 4;
    request.camera =
        renderer.fitCamera("slice", request.scene.layers[0].glyphs().selection, model::Convention::kRadiological, 16.0 / 9);
    std::vector<Candidate> candidates;
    for (const model::GlyphBoxes boxes : {model::GlyphBoxes::kTight, model::GlyphBoxes::kCylinder}) {
        for (const Method& method : glyphMethods({4, false}, {"march", "polynomial,"}))
            addMethod(candidates, request, method, boxes);
        for (const Row& row : kRows) addMethod(candidates, request, rayMarch(row.method, row.steps, row.per_ray), boxes);
    }
    const Comparison comparison = compareMethods(report, renderer, store, "slice", candidates, request, kReferencePixels);
    Table table{"glyph passes, ms, and relative to Peters' method in the tight boxes",
                {"method", "cylinder", "relative", "paper", "relative", "tight", "relative", "paper", "relative"},
                {}};
    const double ours = comparison.medianMs(comparison.best("tight: polynomial"));
    const auto row = [&](const std::string& name, double cylinder, double tight, double paper_cylinder, double paper_tight) {
        const auto shown = [](double ms) { return ms > 0 ? shortNumber(ms) : "-"; };
        table.rows.push_back({name, shown(cylinder), shown(cylinder / ours), shown(paper_cylinder),
                              shown(paper_cylinder / 0.59), shown(tight), shown(tight / ours), shown(paper_tight),
                              shown(paper_tight / 0.59)});
    };
    for (const Row& r : kRows) {
        const std::string name = rayMarch(r.method, r.steps, r.per_ray).name;
        row(name, comparison.medianMs("cylinder: " + name), comparison.medianMs("tight: " + name), r.paper_cylinder_ms,
            r.paper_tight_ms);
    }
    row("polynomial (the paper's own), best setting", comparison.medianMs(comparison.best("cylinder: polynomial")), ours, 0.95,
        0.59);
    for (const char* name : {"march", "march, pole table"}) {
        row(name, comparison.medianMs(std::string("cylinder: ") + name), comparison.medianMs(std::string("tight: ") + name), 0,
            0);
    }
    report.tables.insert(report.tables.begin(), std::move(table));
    addEffects(report, renderer, request);
    report.checks.push_back(
        {"wrong pixels of the march in tight boxes", static_cast<double>(comparison.errorsOf("tight: march").wrong), "<=", 0});
    report.checks.push_back(
        {"polynomial at its best / march, tight boxes", ours / comparison.medianMs(comparison.best("tight: march")), ">=", 1});
    report.notes.push_back("The paper's dataset is not at hand: " + report.scene +
                           " stands for it. Its times are of an Arc A770 at 1920x1080, which has " +
                           shortNumber(1920.0 * 1080 / (static_cast<double>(width) * height)) + " times as many pixels.");
    report.notes.push_back(comparisonNote());
    noteShortfalls(report, height, kReducedHeight);
    return report;
}

}  // namespace radiata::lab
