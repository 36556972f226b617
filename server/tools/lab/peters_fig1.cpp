// peters-fig1: both halves of the figure. Left: one glyph close by, lit by a soft light. Right: the whole slice of 19,600
// glyphs. Passes and their times by the march and by Peters' polynomial, and errors against the double reference. Both lobes
// are shown, as Peters' glyph is |f|. With --image on real data.
// Source: Peters et al. 2023, Fig. 1.
#include "gpu/device.h"
#include "store/glyph_dataset.h"
#include "tools/lab/comparison.h"
#include "tools/lab/experiments.h"
#include "tools/lab/scenes.h"

namespace radiata::lab {
namespace {

constexpr int kPaperHeight = 1080, kReducedHeight = 360;
constexpr std::uint64_t kGlyphs = 19'600;
constexpr int kReferencePixels = 600;

void listPasses(Report& report, const std::string& half, const Comparison& comparison) {
    Table table{half + ": passes of one frame, ms", {"method", "pass", "shader", "ms"}, {}};
    for (const Measured& method : comparison.measured) {
        for (const model::PassTime& pass : method.info.passes) {
            table.rows.push_back({method.name, pass.name, pass.shader, shortNumber(pass.time_ms)});
        }
    }
    report.tables.push_back(std::move(table));
}

}  // namespace

Report petersFig1(gpu::Device& device, const Options& options) {
    Report report;
    report.experiment = "peters-fig1";
    report.repeats = options.rounds(7);
    const int height = pictureHeight(device, options, kPaperHeight, kReducedHeight);
    store::Store store(device, {});
    store.add("slice", slice(options, 4, kGlyphs, report.scene));
    render::Renderer renderer(device, store);
    report.device = renderer.deviceName();
    report.view = std::to_string(height) + "x" + std::to_string(height) + " of about one glyph, and " +
                  std::to_string(height * 16 / 9) + "x" + std::to_string(height) + " of the slice";
    const model::DatasetInfo info = store.info("slice");
    model::FrameRequest right = requestOf("slice", height * 16 / 9, height, true);
    right.scene.layers[0].glyphs().lmax = 4;
    right.quality.traversal = model::Traversal::kAuto;
    right.camera =
        renderer.fitCamera("slice", right.scene.layers[0].glyphs().selection, model::Convention::kRadiological, 16.0 / 9);
    // The glyph nearest to the middle of the slice.
    model::FrameRequest left = right;
    left.width = height;
    const model::ShImage& image = store.glyphs("slice")->image();
    const glm::dvec3 middle = 0.5 * (info.bounds_min + info.bounds_max);
    glm::dvec3 nearest(1e30);
    for (const glm::ivec3& voxel : image.voxels) {
        const glm::dvec3 at(image.voxel_to_world * glm::dvec4(glm::dvec3(voxel), 1.0));
        if (glm::length(at - middle) < glm::length(nearest - middle)) nearest = at;
    }
    left.camera.eye_mm += nearest - left.camera.target_mm;
    left.camera.target_mm = nearest;
    left.camera.height_mm = 1.2 * glm::length(glm::dvec3(info.voxel_to_world[0]));
    left.scene.light.shadow = model::Shadow::kSoft;
    const std::vector<Method> methods = glyphMethods({4, false}, {"march", "polynomial,"});
    const Comparison near =
        compareMethods(report, renderer, store, "left: one glyph", candidatesOf(left, methods), left, kReferencePixels);
    const Comparison far =
        compareMethods(report, renderer, store, "right: slice", candidatesOf(right, methods), right, kReferencePixels);
    listPasses(report, "left", near);
    listPasses(report, "right", far);
    for (const Comparison* half : {&near, &far}) {
        report.checks.push_back({std::string(half == &near ? "left" : "right") + ": wrong pixels of the march",
                                 static_cast<double>(half->errorsOf("march").wrong), "<=", 0});
    }
    report.notes.push_back("The paper's dataset is not at hand: " + report.scene +
                           " stands for it. Its uncertainty is measured by peters-fig5, "
                           "kinds of shadow by peters-fig4.");
    report.notes.push_back(comparisonNote());
    noteShortfalls(report, height, kReducedHeight);
    return report;
}

}  // namespace radiata::lab
