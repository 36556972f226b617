#include "render/frame/fiblet_passes.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "plan/fiblet_view.h"
#include "render/frame/fiblet_buffers.h"
#include "render/frame/fiblet_coverage.h"
#include "render/frame/fiblet_cull.h"
#include "render/frame/fiblet_cut.h"
#include "render/frame/fibre_light.h"

namespace radiata::render {
namespace {

struct BeginPush {
    std::uint64_t layer, surface, opaque;
};
struct RasterPush {
    std::uint64_t layer;
    std::uint32_t first, count;
};
struct SurfacePush {
    std::uint64_t layer, surface, counters;
};

}  // namespace

/// One layer's passes while they run.
class FibletRun {
public:
    FibletRun(PassRun& run, std::size_t layer, bool first, FibletPace& pace)
        : run_(run),
          pace_(pace),
          index_(layer),
          plan_(*run.list.plan->fiblets[index_]),
          scene_(*run.list.layers[index_].tracts),
          own_(*run.target.fiblets[index_]),
          first_(first),
          suffix_(run.list.layers.size() > 1 ? " " + std::to_string(index_) : ""),
          lines_(run, index_, own_, pace, suffix_),
          cull_(run, plan_, scene_, own_, suffix_) {}

    void draw() {
        if (run_.list.frozen) freeze();
        prepare(run_.target.frame().rays, run_.list.camera.reference_mm);
        begin(first_);
        if (atomic()) run_.target.fiblet_lines.reset();
        if (!atomic()) lines_.begin();
        if (scene_.fibletCount() > 0 && run_.list.camera.sees_scene) {
            if (plan_.paged) {
                drawPaged();
            } else if (plan_.culling == model::FibletCulling::kNone || (plan_.culling == model::FibletCulling::kFrustum &&
                                                                        plan::areInside(own_.layer().view, scene_.pages()))) {
                drawAll();
            } else if (run_.list.frozen) {
                step(1, 0, own_.orderPages(scene_));
            } else {
                drawCulled();
            }
        }
        surface();
    }

    void beginPeels(bool counted) {
        peels_ = true;
        prepare(run_.target.frame().rays, run_.list.camera.reference_mm);
        own_.preparePeels(run_.device, run_.pixels(), counted);
    }

    void findPeel(bool first, bool counted) {
        run_.checkCancelled();
        peeling_ = !first;
        counting_ = first && counted;
        begin(false);
        own_.counts() = {};
        if (scene_.fibletCount() > 0 && run_.list.camera.sees_scene) drawPeel();
        counting_ = false;
        toPeelSurface();
    }

    std::uint64_t address() const { return own_.layerAddress(); }

    void findThrough(std::uint64_t inside, std::uint64_t found) {
        peels_ = true;
        prepare(run_.target.frame().rays, run_.list.camera.reference_mm);
        own_.layer().inside = inside;
        own_.layer().found = found;
        own_.counts() = {};
        finding_ = true;
        if (scene_.fibletCount() > 0 && run_.list.camera.sees_scene) drawPeel();
        own_.knows_visible = false;
    }

private:
    /// Transparent layers and outlines are for the atomic pipeline alone.
    bool atomic() const { return peels_ || plan_.pipeline == model::FibletPipeline::kAtomic; }
    bool meshes() const {
        return plan_.pipeline == model::FibletPipeline::kMesh || plan_.pipeline == model::FibletPipeline::kMeshSerial;
    }

    /// The nearest segments that are not composed yet.
    void drawPeel() {
        if (plan_.paged) {
            drawPaged();
        } else if (plan_.culling == model::FibletCulling::kNone) {
            raster(false, 0, static_cast<std::uint32_t>(scene_.fibletCount()));
        } else {
            cull_.cull(0, 0, own_.orderPages(scene_));
            raster(true, 0, own_.counts().listed);
        }
        if (!plan_.paged) own_.drawn = own_.counts().listed;
    }

    void toPeelSurface() {
        const auto resolve = [&] {
            run_.recorder.dispatch(run_.pipelines.get("fiblet_surface", withPaged(plan_, {PassRun::kGroup, first_ ? 1U : 0U, 0U,
                                                                                          0U, plan_.tubes ? 1U : 0U,
                                                                                          plan_.selected_only ? 1U : 0U, 0U})),
                                   "fiblet surface" + suffix_, PassRun::groups(run_.pixels()), 1, 1,
                                   SurfacePush{own_.layerAddress(), run_.target.peel_surface.address(), run_.counterAddress()});
            submit(0);
        };
        resolve();
        while (own_.counts().repaired > 0) {
            const std::uint32_t repaired = own_.counts().repaired;
            own_.counts().repaired = 0;
            redraw(repaired);
            resolve();
        }
    }

    bool twoPhases() const { return plan_.culling == model::FibletCulling::kTwoPhase; }
    bool coverage() const { return plan_.culling == model::FibletCulling::kCoverage; }

    /// Segments that may become one line: a power of two, by which a line is about four pixels long.
    std::uint32_t detailSegments(const shader::FibletView& view) const {
        if (!(plan_.detail_px > 0)) return 0;
        const double segment_px = static_cast<double>(scene_.set().codec.step_mm * glm::length(view.right));
        const double wanted = std::log2(4 / std::max(segment_px, 1e-3));
        return 1U << static_cast<std::uint32_t>(std::clamp(std::round(wanted), 0.0, 5.0));
    }

    /// Lets `visible` be what is seen from the frozen camera.
    void freeze() {
        own_.knows_visible = false;
        prepare(run_.list.frozen->rays, run_.list.frozen->reference_mm);
        begin(true);
        if (!atomic()) lines_.begin();
        if (run_.list.frozen->sees_scene) drawCulled();
        run_.recorder.fill(own_.visible, 0, own_.visible.sizeBytes() / 4 * 4, 0);
        resolve(true, true, true);
        submit(0);
    }

    void prepare(const shader::CameraRays& rays, const glm::dvec3& reference_mm) {
        const Target::Impl& target = run_.target;
        const model::FrameRequest& whole = run_.list.plan->resolved;
        const glm::ivec2 picture(whole.width, whole.height), window(target.width, target.height);
        const glm::vec2 offset = run_.list.pixel_offset;
        // A pick draws a window of the picture; its place is a whole number of pixels.
        const glm::ivec2 first(std::lround(offset.x + 0.5F * static_cast<float>(picture.x - window.x)),
                               std::lround(offset.y + 0.5F * static_cast<float>(picture.y - window.y)));
        const glm::dvec3 origin = scene_.set().origin_mm;
        shader::FibletView view = plan::fibletView(rays, picture, {first, window}, target.frame().jitter - offset,
                                                   reference_mm - origin, scene_.reachMm());
        view.line_width = static_cast<float>(plan_.line_width_px);
        view.tube_radius = plan_.tube_radius_mm;
        const bool ends = (plan_.detail_px > 0 || coverage()) && !plan_.paged;
        // Lines to the start of the next fiblet leave the box of what is decoded by the codec's error.
        const double end_slack = ends ? 2e-3 * scene_.set().errors.max_um : 0;
        view.rounding += static_cast<float>(end_slack);
        own_.prepare(run_.device, scene_, window, plan_.culling != model::FibletCulling::kNone, ends);
        std::vector<shader::FibletCut> cuts;
        for (const model::FibreCut& cut : whole.scene.layers[index_].tracts().cuts) {
            const glm::dvec3 normal = glm::normalize(cut.normal);
            cuts.push_back({glm::vec3(normal), static_cast<float>(glm::dot(normal, cut.point_mm - origin))});
        }
        own_.fill(scene_, view, cuts, run_.list.layers[index_].fibres->stateAddress(), static_cast<std::uint32_t>(index_));
        own_.layer().segments = run_.list.layers[index_].fibres->segmentAddress();
        own_.layer().end_slack = static_cast<float>(end_slack);
        own_.layer().detail_px = plan_.detail_px;
        own_.layer().detail_segments = detailSegments(view);
        if (plan_.mesh_cut) findCutDepths(run_, *run_.list.layers[index_].fibres->filter, own_, suffix_);
        own_.drawn = own_.pages_wanted = own_.pages_left_out = own_.pages_missing = 0;
        run_.target.look(index_).tangents = own_.tangents.address();
    }

    /// \param first  nothing that was drawn before is looked at
    void begin(bool first) {
        if (first) {
            run_.recorder.fill(own_.words, 0, 8 * run_.pixels(), 0xffffffffU);
            return;
        }
        run_.recorder.dispatch(
            run_.pipelines.get("fiblet_begin", {PassRun::kGroup, counting_ ? 1U : 0U}), "fiblet begin" + suffix_,
            PassRun::groups(run_.pixels()), 1, 1,
            BeginPush{own_.layerAddress(), (peels_ && !first_ ? run_.target.peel_surface : run_.target.surface).address(),
                      run_.target.surface.address()});
    }

    /// Submits, and learns from the time how many fiblets the next submission may have.
    void submit(std::uint32_t fiblets) {
        const auto start = std::chrono::steady_clock::now();
        run_.recorder.submitAndWait();
        const double took_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
        pace_.learn(fiblets, took_ms);
    }

    /// By raster.comp: what is drawn by no other pipeline.
    void raster(bool listed, std::uint32_t first, std::uint32_t end) {
        const gpu::ComputePipeline& pipeline = run_.pipelines.get(
            "fiblet_raster",
            withPaged(plan_, {PassRun::kGroup, listed ? 1U : 0U, plan_.cuts, plan_.tubes ? 1U : 0U,
                              plan_.lines && atomic() ? 1U : 0U, plan_.states ? 1U : 0U, plan_.selected_only ? 1U : 0U,
                              plan_.segments ? 1U : 0U, plan_.exact_width ? 1U : 0U, peeling_ ? 1U : 0U, counting_ ? 1U : 0U,
                              finding_ ? 1U : 0U, peels_ ? 0U : own_.layer().detail_segments, coverage() && !peels_ ? 1U : 0U,
                              plan_.mesh_cut ? 1U : 0U, plan_.mesh_outside ? 1U : 0U}));
        while (first < end) {
            run_.checkCancelled();
            const auto wanted = static_cast<std::uint32_t>(std::min(pace_.fiblets, 4e6));
            const std::uint32_t count = std::min(end - first, wanted / PassRun::kGroup * PassRun::kGroup);
            run_.recorder.dispatch(pipeline, "fiblet raster" + suffix_, PassRun::groups(count), 1, 1,
                                   RasterPush{own_.layerAddress(), first, count});
            submit(count);
            first += count;
        }
    }

    void drawCulled() {
        const std::uint32_t pages = own_.orderPages(scene_);
        own_.drawn = 0;
        if (coverage()) {
            if (!own_.coverage) own_.coverage = std::make_unique<FibletCoverage>();
            own_.coverage->cull(run_, plan_, scene_, own_, suffix_);
            submit(0);
            drawListed(true);
            return;
        }
        if (!twoPhases()) {
            step(0, 0, pages);
            return;
        }
        if (own_.knows_visible) {
            step(1, 0, pages);
        } else {
            run_.recorder.fill(own_.visible, 0, own_.visible.sizeBytes() / 4 * 4, 0);
        }
        cull_.inParts(pages, [this](std::uint32_t first, std::uint32_t end) { step(2, first, end); });
    }

    /// Of a scene that is not all on the device. What is seen of a page depends on the subset and on nearer pages alone, so a
    /// picture for which all pages came that have room does not depend on what was drawn before.
    void drawPaged() {
        const std::uint32_t pages = own_.orderPages(scene_);
        own_.drawn = own_.pages_wanted = own_.pages_left_out = 0;
        if (run_.list.all_pages) return drawAllPages();
        std::vector<std::uint32_t> missing;
        const auto draw = [&](std::uint32_t phase, std::uint32_t first, std::uint32_t end) {
            cull_.cullPaged(phase, first, end, missing);
            drawListed(true);
        };
        if (twoPhases()) {
            cull_.inParts(pages, [&](std::uint32_t first, std::uint32_t end) { draw(3, first, end); });
        } else {
            draw(0, 0, pages);
        }
        scene_.residency()->want(run_.recorder, missing);
        own_.pages_missing = missing.size();
        run_.target.pages_missing = run_.target.pages_missing || !missing.empty();
    }

    /// Everything in the frustum, in as many rounds as the pages need that have room beside each other.
    void drawAllPages() {
        FibletResidency& residency = *scene_.residency();
        const std::vector<std::uint32_t> found = cull_.foundPages(0, 0, static_cast<std::uint32_t>(scene_.pages().size()));
        own_.pages_wanted = found.size();
        own_.drawn = 0;
        for (std::size_t first = 0; first < found.size(); first += residency.slots()) {
            run_.checkCancelled();
            const auto round = std::span(found).subspan(first, std::min<std::size_t>(residency.slots(), found.size() - first));
            residency.begin();
            for (const std::uint32_t page : round) residency.take(page);
            residency.fetch(run_.recorder, round, {}, run_.cancel);
            own_.counts().listed = 0;
            cull_.cullFound(0, round);
            raster(true, 0, own_.counts().listed);
            own_.drawn += own_.counts().listed;
        }
    }

    /// Draws what a phase of culling leaves of some pages in their order.
    void step(std::uint32_t phase, std::uint32_t first, std::uint32_t end) {
        const bool mesh_lines = meshes() && plan_.lines;
        if (mesh_lines) lines_.drawPages(phase, first, end, !plan_.tubes);
        if (!mesh_lines || plan_.tubes) cull_.cull(phase, first, end);
        drawListed(!mesh_lines);
    }

    /// Fiblets of the list; of pictures whose pages are drawn one after the other all.
    void redraw(std::uint32_t listed) {
        if (plan_.paged && run_.list.all_pages) {
            drawAllPages();
        } else {
            raster(true, 0, listed);
        }
    }

    /// What is new in the list. \param lines  not only tubes
    void drawListed(bool lines) {
        const std::uint32_t listed = own_.counts().listed, drawn = static_cast<std::uint32_t>(own_.drawn);
        if (!atomic() && lines && plan_.lines) lines_.draw(true, drawn, listed);
        if (atomic() || plan_.tubes) raster(true, drawn, listed);
        own_.drawn = listed;
    }

    void drawAll() {
        const auto all = static_cast<std::uint32_t>(scene_.fibletCount());
        if (meshes() && plan_.lines) {
            lines_.drawPages(3, 0, static_cast<std::uint32_t>(scene_.pages().size()), false);
        } else if (!atomic() && plan_.lines) {
            lines_.draw(false, 0, all);
        }
        if (atomic() || plan_.tubes) raster(false, 0, all);
        own_.drawn = all;
    }

    void surface() {
        const bool marks = twoPhases() && !run_.list.frozen && !plan_.paged;
        if (marks) run_.recorder.fill(own_.visible, 0, own_.visible.sizeBytes() / 4 * 4, 0);
        resolve(marks, false, false);
        submit(0);
        // Tangents that a loser of the race overwrote; a second drawing finds the final words.
        while (own_.counts().repaired > 0) {
            const std::uint32_t repaired = own_.counts().repaired;
            own_.counts().repaired = 0;
            redraw(repaired);
            resolve(false, true, false);
            submit(0);
        }
        own_.knows_visible = marks;
        if (!coverage()) {
            own_.coverage.reset();
        } else if (own_.coverage && !run_.list.frozen) {
            cull_.pyramid();
            own_.coverage->remember(run_, scene_, own_, suffix_);
            submit(0);
        }
    }

    /// \param again  pixels were counted before \param marks_only  leaves the surface buffer alone
    void resolve(bool marks, bool again, bool marks_only) {
        if (!marks_only && lightsFibres(run_)) return lightFibres(run_, plan_, own_, marks, again);
        run_.recorder.dispatch(
            run_.pipelines.get("fiblet_surface",
                               withPaged(plan_, {PassRun::kGroup, first_ ? 1U : 0U, marks ? 1U : 0U, again ? 0U : 1U,
                                                 plan_.tubes ? 1U : 0U, plan_.selected_only ? 1U : 0U, marks_only ? 1U : 0U})),
            "fiblet surface" + suffix_, PassRun::groups(run_.pixels()), 1, 1,
            SurfacePush{own_.layerAddress(), run_.target.surface.address(), run_.counterAddress()});
    }

    PassRun& run_;
    FibletPace& pace_;
    std::size_t index_;
    const plan::FibletPlan& plan_;
    const FibletScene& scene_;
    FibletBuffers& own_;
    bool first_;                               ///< nothing is in the surface buffer, or peel surface, yet
    bool peels_ = false;                       ///< segment by segment, one behind the other
    bool finding_ = false;                     ///< fibres in an outline are noted, nothing is drawn
    bool peeling_ = false, counting_ = false;  ///< of transparent layers: what was composed is left out; segments are counted
    std::string suffix_;
    FibletLines lines_;
    FibletCull cull_;
};

FibletPeel::FibletPeel(PassRun& run, std::size_t layer, FibletPace& pace, bool alone, bool counted)
    : run_(std::make_unique<FibletRun>(run, layer, alone, pace)), counted_(counted) {
    run_->beginPeels(counted);
}
FibletPeel::~FibletPeel() = default;
FibletPeel::FibletPeel(FibletPeel&&) noexcept = default;

void FibletPeel::find(bool first) { run_->findPeel(first, counted_); }

std::uint64_t FibletPeel::address() const { return run_->address(); }

void runFibletsThrough(PassRun& run, const plan::PassPlan& pass, std::uint64_t inside, std::uint64_t found) {
    FibletPace pace;
    FibletRun(run, static_cast<std::size_t>(pass.layer), pass.first, pace).findThrough(inside, found);
}

void runFiblets(PassRun& run, const plan::PassPlan& pass, FibletPace& pace) {
    FibletRun(run, static_cast<std::size_t>(pass.layer), pass.first, pace).draw();
}

}  // namespace radiata::render
