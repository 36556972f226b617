// schertzer-fig8: pixels that differ between fibres as fiblets and the same fibres without compression, from far and from near.
// The uncompressed picture is that of the reference in double precision, so differences are those of the codec and of floats
// alone. Source: Schertzer et al. 2022, Fig. 8, which finds them sparse and no farther than a pixel.
#include "build/fiblet_encode.h"
#include "gpu/device.h"
#include "reference/fibre_picture.h"
#include "store/store.h"
#include "tools/lab/experiments.h"
#include "tools/lab/fibre_pipelines.h"
#include "tools/lab/measure.h"
#include "tools/lab/tract_scenes.h"

namespace radiata::lab {
namespace {

constexpr std::size_t kFibres = 200;
constexpr int kHeight = 720;
constexpr double kNear = 12;  // times

std::vector<reference::FibreSegment> segmentsOf(const model::Tractogram& tractogram) {
    std::vector<reference::FibreSegment> segments;
    for (std::size_t f = 0; f < tractogram.fibreCount(); ++f) {
        const auto points = tractogram.fibre(f);
        for (std::size_t i = 0; i + 1 < points.size(); ++i) {
            segments.push_back({glm::dvec3(points[i]), glm::dvec3(points[i + 1]), static_cast<std::uint32_t>(f)});
        }
    }
    return segments;
}

}  // namespace

Report schertzerFig8(gpu::Device& device, const Options& options) {
    Report report;
    report.experiment = "schertzer-fig8";
    report.repeats = 1;
    report.scene = "at most " + std::to_string(kFibres) + " fibres of each tractogram, by the pipeline atomic";
    const int height = pictureHeight(device, options, kHeight, kHeight);
    report.view = std::to_string(height * 16 / 9) + "x" + std::to_string(height) + ", whole and 12 times as near";
    Table table{"pixels that show another fibre than without compression",
                {"fibres", "bound, um", "bytes a point", "view", "pixels shown", "other, %", "only one shows something, %",
                 "not within a pixel, %"},
                {}};
    double worst_far = 0, worst_whole = 0;
    for (const TractScene& scene : tractScenes(kFibres)) {
        const std::vector<reference::FibreSegment> segments = segmentsOf(scene.tractogram);
        for (const double bound_um : {10.0, 25.0}) {
            store::Store store(device, {});
            model::FibletSet set = encodeFiblets(scene.tractogram, {.bound_um = bound_um});
            const double bytes = static_cast<double>(std::span(set.heads).size_bytes() + std::span(set.codes).size_bytes()) /
                                 static_cast<double>(set.points);
            store.add("fibres", std::move(set));
            render::Renderer renderer(device, store);
            report.device = renderer.deviceName();
            model::FrameRequest request = fibreFrame(height, "fibres");
            request.quality.fiblet_pipeline = model::FibletPipeline::kAtomic;
            request.camera = renderer.fitCamera("fibres", {}, model::Convention::kRadiological,
                                                static_cast<double>(request.width) / request.height);
            for (const bool near : {false, true}) {
                if (near) request.camera.height_mm /= kNear;
                model::Outputs ids;
                ids.id = true;
                const std::vector<std::int32_t> ours = fibresOf(renderer.renderAll(request, ids).pixels);
                std::vector<std::int32_t> raw;
                for (const reference::FibrePixel& pixel :
                     reference::fibrePicture(segments, request.camera, request.width, request.height)) {
                    raw.push_back(pixel.who == reference::FibrePixel::kNobody ? -1 : static_cast<std::int32_t>(pixel.who));
                }
                const FibreDifferences apart = compareFibres(raw, ours, request.width);
                table.rows.push_back({scene.name, shortNumber(bound_um), shortNumber(bytes), near ? "near" : "whole",
                                      std::to_string(apart.shown), shortNumber(apart.share(apart.fibre)),
                                      shortNumber(apart.share(apart.alone)), shortNumber(apart.share(apart.far))});
                if (bound_um == 10.0) {
                    worst_far = std::max(worst_far, apart.share(apart.far));
                    if (!near) worst_whole = std::max(worst_whole, apart.share(apart.fibre));
                }
            }
        }
    }
    report.tables.push_back(table);
    report.checks.push_back({"10 um: pixels whose fibre is not within a pixel, %", worst_far, "<=", 0.5});
    report.checks.push_back({"10 um: pixels that show another fibre, whole, %", worst_whole, "<=", 5});
    noteShortfalls(report, height, kHeight);
    report.shortfalls.clear();  // counts, not times: one round tells all
    return report;
}

}  // namespace radiata::lab
