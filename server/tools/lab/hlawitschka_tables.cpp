// hlawitschka-table1: frames per second of tensor-march with each step and
// refinement; hlawitschka-table2: of 258 glyphs of order 4 as
// latitude-longitude grids of resolution 7, 10 and 20 and by ray casting, with
// the time that the geometry takes to make. Source: Hlawitschka et al., Tables
// 1 and 2 (800x600, GeForce 9600M GT).
#include <algorithm>

#include "gpu/device.h"
#include "tools/lab/comparison.h"
#include "tools/lab/experiments.h"
#include "tools/lab/scenes.h"
#include "tools/lab/tensor_scenes.h"

namespace radiata::lab {
namespace {

constexpr int kPaperHeight = 600, kReducedHeight = 240;
constexpr std::size_t kGlyphs = 258;
constexpr int kReferencePixels = 1500;

struct Brick {
    store::Store store;
    render::Renderer renderer;
    model::FrameRequest request;

    Brick(gpu::Device& device, int height)
        : store(device, {}), renderer((store.add("brick", stiffnessGlyphs(kGlyphs)), device), store) {
        request = requestOf("brick", height * 4 / 3, height, true);
        request.camera =
            renderer.fitCamera("brick", request.scene.layers[0].glyphs().selection, model::Convention::kRadiological, 4.0 / 3);
    }
};

Report begun(gpu::Device& device, const Options& options, const std::string& name, int& height) {
    Report report;
    report.experiment = name;
    report.repeats = options.rounds(15);
    height = pictureHeight(device, options, kPaperHeight, kReducedHeight);
    report.scene = std::to_string(kGlyphs) + " glyphs of order 4 of the sample stiffness field, both signs shown";
    report.view = std::to_string(height * 4 / 3) + "x" + std::to_string(height) + ", fitted; the paper: 800x600";
    report.device = device.info().name + ", " + device.info().driver;
    report.notes.push_back(
        "The paper's data are not at hand: a sample field of a fibre-reinforced "
        "brick stands for them. Frames per second from "
        "the glyph passes alone. At 800x600 there are " +
        shortNumber(static_cast<double>(kPaperHeight) * kPaperHeight / (static_cast<double>(height) * height)) +
        " times as many pixels (extrapolated rates are that much lower).");
    return report;
}

}  // namespace

Report hlawitschkaTable1(gpu::Device& device, const Options& options) {
    int height = 0;
    Report report = begun(device, options, "hlawitschka-table1", height);
    Brick brick(device, height);
    std::vector<Method> methods = glyphMethods({4, false}, {"march"});
    for (const Method& method : tensorMarches(false)) methods.push_back(method);
    for (const Method& method : tensorRanges()) methods.push_back(method);
    const Comparison comparison = compareMethods(report, brick.renderer, brick.store, "brick",
                                                 candidatesOf(brick.request, methods), brick.request, kReferencePixels);
    const char* refinements[] = {"bisect 0", "bisect 1", "bisect 2", "bisect 3", "interpolation"};
    const char* paper[][5] = {
        {"5.0", "5.0", "5.0", "5.0", "4.8"}, {"8.6", "9.3", "9.1", "9.0", "8.5"}, {"18.6", "19.0", "18.7", "18.0", "18.0"}};
    Table table{"frames per second, in brackets the paper's (GeForce 9600M GT)",
                {"step", "bisect 0", "bisect 1", "bisect 2", "bisect 3", "interpolation"},
                {}};
    const char* steps[] = {"0.01", "0.02", "0.05"};
    for (std::size_t s = 0; s < 3; ++s) {
        std::vector<std::string> row{steps[s]};
        for (std::size_t r = 0; r < 5; ++r) {
            const double ms = comparison.medianMs("tensor-march, step " + std::string(steps[s]) + ", " + refinements[r]);
            row.push_back(shortNumber(1000 / ms) + " (" + paper[s][r] + ")");
        }
        table.rows.push_back(std::move(row));
    }
    for (const char* other : {"march", "march, pole table", "tensor-interval", "tensor-affine"}) {
        table.rows.push_back({other, shortNumber(1000 / comparison.medianMs(other)), "", "", "", ""});
    }
    report.tables.insert(report.tables.begin(), std::move(table));
    report.checks.push_back({"step 0.05 / step 0.01, frames per second (paper: 3.7)",
                             comparison.medianMs("tensor-march, step 0.01, interpolation") /
                                 comparison.medianMs("tensor-march, step 0.05, interpolation"),
                             ">=", 1});
    report.notes.push_back(comparisonNote());
    noteShortfalls(report, height, kReducedHeight);
    return report;
}

Report hlawitschkaTable2(gpu::Device& device, const Options& options) {
    int height = 0;
    Report report = begun(device, options, "hlawitschka-table2", height);
    Brick brick(device, height);
    std::vector<Method> methods = glyphMethods({4, false}, {"march", "tessellated, grid"});
    for (const Method& method : tensorMarches(false)) {
        if (method.name == "tensor-march, step 0.05, interpolation" ||
            method.name == "tensor-march, step 0.02, interpolation") {
            methods.push_back(method);
        }
    }
    const Comparison comparison = compareMethods(report, brick.renderer, brick.store, "brick",
                                                 candidatesOf(brick.request, methods), brick.request, kReferencePixels);
    Table table{"frames per second",
                {"method", "geometry, ms", "drawing, ms", "frames per second", "wrong px", "paper: generation", "paper: fps"},
                {}};
    for (std::size_t i = 0; i < comparison.measured.size(); ++i) {
        const Measured& method = comparison.measured[i];
        // The geometry depends on the glyphs alone; it is made again for each
        // picture here, in this pass.
        const double geometry = passTime(method.info, {"glyph tessellate"});
        const double drawing = method.time.median() - geometry;
        std::string generation, fps;
        if (method.name == "tessellated, grid 7") generation = "1 s", fps = "60";
        if (method.name == "tessellated, grid 10") generation = "3 s", fps = "59";
        if (method.name == "tessellated, grid 20") generation = "9 s", fps = "50";
        if (method.name.starts_with("tensor-march, step 0.05")) generation = "< 1 s", fps = "18";
        table.rows.push_back({method.name, shortNumber(geometry), shortNumber(drawing),
                              shortNumber(1000 / method.time.median()), std::to_string(comparison.errors[i].wrong), generation,
                              fps});
    }
    report.tables.insert(report.tables.begin(), std::move(table));
    report.checks.push_back({"wrong pixels of grid 7 - of the march",
                             static_cast<double>(comparison.errorsOf("tessellated, grid 7").wrong) -
                                 static_cast<double>(comparison.errorsOf("march").wrong),
                             ">=", 1});
    report.notes.push_back(comparisonNote());
    noteShortfalls(report, height, kReducedHeight);
    return report;
}

}  // namespace radiata::lab
