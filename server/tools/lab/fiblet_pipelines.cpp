// fiblet-pipelines: the same fibres by every pipeline, whole, in a close-up and whole with a level of detail: time per drawn
// segment, and pixels that show other fibres than the compute shader does.
#include <array>
#include <map>
#include <optional>

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
constexpr float kDetailPx = 1;
constexpr std::size_t kFibresOnGpu = 100'000, kFibresOnCpu = 5000;

struct View {
    const char* name;
    double closer;
    model::FibletCulling culling;
    std::optional<float> detail_px;  ///< by pipelines that draw fiblets
};
const std::array kViews{View{"whole", 1, model::FibletCulling::kNone, {}},
                        View{"close-up", kCloseUp, model::FibletCulling::kFrustum, {}},
                        View{"detail", 1, model::FibletCulling::kNone, kDetailPx}};

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
        "; whole: nothing culled; close-up, 15 times as near: what is outside of the picture culled, if the pipeline can; "
        "detail: the whole, by lines that stand for many segments and are off by a pixel at most";
    request.camera =
        renderer.fitCamera("fibres", {}, model::Convention::kRadiological, static_cast<double>(request.width) / request.height);
    const double whole_mm = request.camera.height_mm;
    Table table{"time of the passes of fibres",
                {"pipeline", "view", "ms", "million segments", "ns a segment", "off by px, at most", "other fibre, % of pixels",
                 "not within a pixel, %"},
                {}};
    std::map<std::pair<std::string_view, model::FibletPipeline>, double> ns;
    double most_far = 0;
    for (const View& view : kViews) {
        request.camera.height_mm = whole_mm / view.closer;
        request.quality.fiblet_culling = view.culling;
        request.quality.fiblet_detail_px = view.detail_px;
        std::vector<Candidate> candidates;
        std::vector<std::vector<std::int32_t>> pictures;
        std::vector<model::FibletPipeline> pipelines;
        model::Outputs ids;
        ids.id = true;
        for (const model::FibletPipeline pipeline : kFibrePipelines) {
            if (view.detail_px && model::drawsUncompressed(pipeline)) continue;
            request.quality.fiblet_pipeline = pipeline;
            candidates.push_back({nameOf(pipeline) + ", " + view.name, "", request});
            pictures.push_back(fibresOf(renderer.renderAll(request, ids).pixels));
            pipelines.push_back(pipeline);
        }
        const std::vector<Measured> measured = measure(renderer, candidates, report.repeats, {"fiblet"});
        for (std::size_t i = 0; i < measured.size(); ++i) {
            const double segments = per_fiblet * static_cast<double>(measured[i].info.fiblets_drawn);
            const double each = ns[{view.name, pipelines[i]}] = 1e6 * measured[i].time.median() / segments;
            const FibreDifferences apart = compareFibres(pictures[0], pictures[i], request.width);
            if (pipelines[i] != model::FibletPipeline::kPoints) most_far = std::max(most_far, apart.share(apart.far));
            table.rows.push_back({nameOf(pipelines[i]), view.name, shortNumber(measured[i].time.median()),
                                  shortNumber(1e-6 * segments), shortNumber(each),
                                  shortNumber(measured[i].info.fiblet_error_px), shortNumber(apart.share(apart.fibre)),
                                  shortNumber(apart.share(apart.far))});
            report.series.push_back(measured[i].time);
        }
    }
    const auto of = [&](const char* view, model::FibletPipeline pipeline) { return ns.at({view, pipeline}); };
    constexpr auto kAtomic = model::FibletPipeline::kAtomic, kMesh = model::FibletPipeline::kMesh;
    report.tables.push_back(table);
    report.checks.push_back(
        {"mesh / atomic, time per drawn segment, whole", of("whole", kMesh) / of("whole", kAtomic), ">=", 10});
    report.checks.push_back(
        {"mesh / atomic, time per drawn segment, close-up", of("close-up", kMesh) / of("close-up", kAtomic), ">=", 1});
    report.checks.push_back({"atomic, million segments a second, whole", 1e3 / of("whole", kAtomic), ">=", 20});
    for (const model::FibletPipeline pipeline : kFibrePipelines) {
        if (model::drawsUncompressed(pipeline)) continue;
        report.checks.push_back({"detail / whole, time per segment that is stood for, " + nameOf(pipeline),
                                 of("detail", pipeline) / of("whole", pipeline), "<=", 1});
    }
    report.checks.push_back({"pixels whose fibre is not within a pixel, any pipeline but points, %", most_far, "<=", 1});
    noteShortfalls(report, request.height, kHeight);
    return report;
}

}  // namespace radiata::lab
