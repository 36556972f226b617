#include "render/frame/fiblet_run.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "plan/fiblet_view.h"
#include "render/frame/fiblet_cut.h"

namespace radiata::render {
namespace {

/// Segments that may become one line: a power of two, by which a line is about four pixels long. \param pixels  of a
/// millimetre
std::uint32_t detailSegments(const plan::FibletPlan& plan, const shader::FibletCodec& codec, float pixels) {
    if (!(plan.detail_px > 0)) return 0;
    const auto segment_px = static_cast<double>(codec.step_mm * pixels);
    const double wanted = std::log2(4 / std::max(segment_px, 1e-3));
    return 1U << static_cast<std::uint32_t>(std::clamp(std::round(wanted), 0.0, 5.0));
}

/// First pixel of the window that is drawn. A pick draws a window of the picture; its place is a whole number of pixels.
glm::ivec2 windowPlace(const glm::vec2& offset, const glm::ivec2& picture, const glm::ivec2& window) {
    return {std::lround(offset.x + 0.5F * static_cast<float>(picture.x - window.x)),
            std::lround(offset.y + 0.5F * static_cast<float>(picture.y - window.y))};
}

}  // namespace

void FibletPace::learn(std::uint64_t drawn, double took_ms) {
    if (drawn == 0) return;
    fiblets =
        std::clamp(static_cast<double>(drawn) * std::clamp(kSubmissionMs / std::max(took_ms, 0.01), 0.25, 4.0), 256.0, 1e9);
}

FibletRun::FibletRun(PassRun& pass_run, std::size_t layer, bool first_layer, FibletPace& fiblet_pace)
    : run(pass_run),
      pace(fiblet_pace),
      index(layer),
      plan(*run.list.plan->fiblets[layer]),
      scene(*run.list.layers[layer].tracts),
      own(*run.target.fiblets[layer]),
      first(first_layer),
      suffix(run.list.layers.size() > 1 ? " " + std::to_string(layer) : "") {}

void FibletRun::prepare(const shader::CameraRays& rays, const glm::dvec3& reference_mm) {
    const Target::Impl& target = run.target;
    const model::FrameRequest& whole = run.list.plan->resolved;
    const FibreLook& fibres = *run.list.layers[index].fibres;
    const glm::ivec2 picture(whole.width, whole.height), window(target.width, target.height);
    const glm::vec2 offset = run.list.pixel_offset;
    const glm::dvec3 origin = scene.set().origin_mm;
    shader::FibletView view = plan::fibletView(rays, picture, {windowPlace(offset, picture, window), window},
                                               target.frame().jitter - offset, reference_mm - origin, scene.reachMm());
    view.line_width = static_cast<float>(plan.line_width_px);
    view.tube_radius = plan.tube_radius_mm;
    const bool ends = (plan.detail_px > 0 || byCoverage()) && !plan.paged;
    // Lines to the start of the next fiblet leave the box of what is decoded by the codec's error.
    const double end_slack = ends ? 2e-3 * scene.set().errors.max_um : 0;
    view.rounding += static_cast<float>(end_slack);
    own.prepare(run.device, scene, window, plan.culling != model::FibletCulling::kNone, ends);
    std::vector<shader::FibletCut> cuts;
    for (const model::FibreCut& cut : whole.scene.layers[index].tracts().cuts) {
        const glm::dvec3 normal = glm::normalize(cut.normal);
        cuts.push_back({glm::vec3(normal), static_cast<float>(glm::dot(normal, cut.point_mm - origin))});
    }
    own.fill(scene, view, cuts, fibres.stateAddress(), static_cast<std::uint32_t>(index));
    own.layer().segments = fibres.segmentAddress();
    own.layer().end_slack = static_cast<float>(end_slack);
    own.layer().detail_px = plan.detail_px;
    own.layer().detail_segments = detailSegments(plan, scene.set().codec, glm::length(view.right));
    if (plan.mesh_cut) findCutDepths(run, *fibres.filter, own, suffix);
    own.drawn = own.pages_wanted = own.pages_left_out = own.pages_missing = 0;
    run.target.look(index).tangents = own.tangents.address();
}

void FibletRun::submit(std::uint64_t fiblets) {
    const auto start = std::chrono::steady_clock::now();
    run.recorder.submitAndWait();
    pace.learn(fiblets, std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
}

std::vector<std::uint32_t> FibletRun::withPaged(std::vector<std::uint32_t> constants) const {
    if (plan.paged) constants.push_back(1U);
    return constants;
}

}  // namespace radiata::render
