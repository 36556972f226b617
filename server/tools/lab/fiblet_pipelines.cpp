// fiblet-pipelines: the same fibres by every pipeline, whole and in a close-up: time per drawn segment, and pixels that show
// other fibres than the compute shader does.
#include "gpu/device.h"
#include "store/store.h"
#include "tools/lab/experiments.h"
#include "tools/lab/fibre_pipelines.h"
#include "tools/lab/measure.h"
#include "tools/lab/tract_scenes.h"

namespace radiata::lab {
namespace {

constexpr int kHeight = 720;
constexpr double kCloseUp = 15;  // as far as the whole
constexpr std::size_t kFibresOnGpu = 100'000, kFibresOnCpu = 5000;

}  // namespace

Report fibletPipelines(gpu::Device& device, const Options& options) {
    Report report;
    report.experiment = "fiblet-pipelines";
    report.repeats = options.rounds(7);
    const std::size_t fibres = device.info().software ? kFibresOnCpu : kFibresOnGpu;
    report.scene = std::to_string(fibres) + " generated fibres of 800 points, 0.1 mm apart, in a ball of 140 mm";
    store::Store store(device, {});
    model::FibletSet set = ballOfFibres(fibres);
    const double per_fiblet = static_cast<double>(set.points - set.fibres()) / static_cast<double>(set.heads.size());
    store.add("fibres", std::move(set));
    render::Renderer renderer(device, store);
    report.device = renderer.deviceName();
    model::FrameRequest request = fibreFrame(pictureHeight(device, options, kHeight, kHeight), "fibres");
    report.view =
        std::to_string(request.width) + "x" + std::to_string(request.height) +
        "; whole: nothing culled; close-up, 15 times as near: what is outside of the picture culled, if the pipeline can";
    request.camera =
        renderer.fitCamera("fibres", {}, model::Convention::kRadiological, static_cast<double>(request.width) / request.height);
    Table table{
        "time of the passes of fibres",
        {"pipeline", "view", "ms", "million segments", "ns a segment", "other fibre, % of pixels", "not within a pixel, %"},
        {}};
    double atomic_ns[2] = {}, mesh_ns[2] = {}, most_far = 0;
    for (const bool close : {false, true}) {
        if (close) request.camera.height_mm /= kCloseUp;
        request.quality.fiblet_culling = close ? model::FibletCulling::kFrustum : model::FibletCulling::kNone;
        std::vector<Candidate> candidates;
        std::vector<std::vector<std::int32_t>> pictures;
        model::Outputs ids;
        ids.id = true;
        for (const model::FibletPipeline pipeline : kFibrePipelines) {
            request.quality.fiblet_pipeline = pipeline;
            candidates.push_back({nameOf(pipeline) + (close ? ", close-up" : ", whole"), "", request});
            pictures.push_back(fibresOf(renderer.renderAll(request, ids).pixels));
        }
        const std::vector<Measured> measured = measure(renderer, candidates, report.repeats, {"fiblet"});
        for (std::size_t i = 0; i < measured.size(); ++i) {
            const double segments = per_fiblet * static_cast<double>(measured[i].info.fiblets_drawn);
            const double ns = 1e6 * measured[i].time.median() / segments;
            const FibreDifferences apart = compareFibres(pictures[0], pictures[i], request.width);
            if (kFibrePipelines[i] == model::FibletPipeline::kAtomic) atomic_ns[close] = ns;
            if (kFibrePipelines[i] == model::FibletPipeline::kMesh) mesh_ns[close] = ns;
            if (kFibrePipelines[i] != model::FibletPipeline::kPoints) most_far = std::max(most_far, apart.share(apart.far));
            table.rows.push_back({nameOf(kFibrePipelines[i]), close ? "close-up" : "whole",
                                  shortNumber(measured[i].time.median()), shortNumber(1e-6 * segments), shortNumber(ns),
                                  shortNumber(apart.share(apart.fibre)), shortNumber(apart.share(apart.far))});
            report.series.push_back(measured[i].time);
        }
    }
    report.tables.push_back(table);
    report.checks.push_back({"mesh / atomic, time per drawn segment, whole", mesh_ns[0] / atomic_ns[0], ">=", 10});
    report.checks.push_back({"mesh / atomic, time per drawn segment, close-up", mesh_ns[1] / atomic_ns[1], ">=", 1});
    report.checks.push_back({"atomic, million segments a second, whole", 1e3 / atomic_ns[0], ">=", 20});
    report.checks.push_back({"pixels whose fibre is not within a pixel, any pipeline but points, %", most_far, "<=", 1});
    noteShortfalls(report, request.height, kHeight);
    return report;
}

}  // namespace radiata::lab
