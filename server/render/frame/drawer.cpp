#include "render/frame/drawer.h"

#include <cmath>

#include "gpu/device.h"
#include "render/frame/fibre_light.h"
#include "render/frame/frame_parameters.h"
#include "render/frame/glyph_passes.h"
#include "render/frame/illumination_passes.h"
#include "render/frame/isosurface_passes.h"
#include "render/frame/light_passes.h"
#include "render/frame/path_passes.h"
#include "render/frame/peel_passes.h"
#include "render/frame/surface_looks.h"
#include "render/frame/uncertainty_passes.h"
#include "render/frame/visibility_passes.h"

namespace radiata::render {
namespace {

/// Sample positions within the pixel: the centre first, then the R2 sequence (Roberts 2018), which fills the square evenly.
glm::vec2 jitterOf(int sample) {
    if (sample == 0) return glm::vec2(0);
    const double x = 0.5 + 0.7548776662466927 * sample, y = 0.5 + 0.5698402909980532 * sample;
    return {static_cast<float>(x - std::floor(x) - 0.5), static_cast<float>(y - std::floor(y) - 0.5)};
}

/// Pages of earlier pictures may give way. \return  a number that is another once others drew from the same scenes
std::uint64_t beginPages(const DrawList& list) {
    for (const DrawnLayer& layer : list.layers) {
        if (layer.tracts && layer.tracts->residency()) layer.tracts->residency()->begin();
    }
    return pagesSerial(list);
}

}  // namespace

std::uint64_t pagesSerial(const DrawList& list) {
    std::uint64_t sum = 0;
    for (const DrawnLayer& layer : list.layers) {
        if (layer.tracts && layer.tracts->residency()) sum += layer.tracts->residency()->serial();
    }
    return sum;
}

Drawer::Drawer(gpu::Device& device) : device_(device), recorder_(device), pipelines_(device), colour_tables_(device) {}

void Drawer::run(PassRun& pass_run, const plan::PassPlan& pass) {
    switch (pass.kind) {
        case plan::PassKind::kGlyphTable:
            return runGlyphTable(pass_run, pass);
        case plan::PassKind::kGlyphTrace:
            return runGlyphTrace(pass_run, pass, false, trace_bands_);
        case plan::PassKind::kSunTable:
            return runSunTable(pass_run, pass);
        case plan::PassKind::kShadow:
        case plan::PassKind::kOcclusion:
            return runVisibility(pass_run, pass, visibility_bands_);
        case plan::PassKind::kUncertaintyTable:
            return runUncertaintyTable(pass_run, pass);
        case plan::PassKind::kUncertainty:
            return runUncertainty(pass_run, pass, uncertainty_bands_);
        case plan::PassKind::kGlyphBoxes:
            return runGlyphBoxes(pass_run, pass, false, boxes_size_);
        case plan::PassKind::kGlyphTessellate:
            return;  // with the mesh that it makes
        case plan::PassKind::kGlyphMesh:
            return runGlyphMesh(pass_run, pass, mesh_size_);
        case plan::PassKind::kRasterSurface:
            return runRasterSurface(pass_run, pass);
        case plan::PassKind::kFiblets:
            return runFiblets(pass_run, pass, fiblet_pace_);
        case plan::PassKind::kPeels:
            return runPeels(pass_run, pass, fiblet_pace_, veil_bands_);
        case plan::PassKind::kClear:
            return runClear(pass_run, pass);
        case plan::PassKind::kIsosurfaceTrace:
            return runIsosurfaceTrace(pass_run, pass, surface_bands_);
        case plan::PassKind::kIsosurfaceMesh:
            return runIsosurfaceMesh(pass_run, pass, triangle_pace_);
        case plan::PassKind::kIsosurfaceVeil:
            return runIsosurfaceVeil(pass_run, pass, veil_bands_);
        case plan::PassKind::kIllumination:
            return runIllumination(pass_run, pass);
        case plan::PassKind::kPixelPaths:
            return runPixelPaths(pass_run, pass, path_bands_);
        case plan::PassKind::kLight:
            if (lightsFibres(pass_run)) return;  // with the fibres
            return runLight(pass_run, pass);
        case plan::PassKind::kResolve:
        case plan::PassKind::kFxaa:
            return;  // after the last sample, by resolve()
    }
}

void Drawer::drawSample(Target::Impl& target, const DrawList& list, int sample, const std::atomic<bool>* cancel) {
    try {
        if (sample == 0) {
            target.samples = 0;
            target.settled = list.settled;
            target.approximate = false;
            if (!list.same_view) target.surface_number = ++surfaces_;
            fillFrameParameters(device_, colour_tables_, target, list);
            fillIsosurfaceParameters(device_, target, list);
            fillSurfaceLooks(device_, target, list);
            fillVisibilityParameters(device_, target, list);
            fillUncertaintyParameters(device_, target, list);
            target.counters() = Counters{};
        }
        target.frame().jitter = jitterOf(sample) + list.pixel_offset;
        target.frame().sample_index = static_cast<std::uint32_t>(sample);
        target.pages_missing = false;
        target.pages_serial = beginPages(list);
        PassRun pass_run{device_, recorder_, pipelines_, target, list, sample, cancel};
        prepareRaster(pass_run);
        for (const plan::PassPlan& pass : list.plan->passes) {
            if (pass.peeled) {
                runPeeled(pass_run, pass, [&] { run(pass_run, pass); });
            } else {
                run(pass_run, pass);
            }
        }
        recorder_.submitAndWait();
        target.samples = sample + 1;
        // A dataset that the view shows beside may be another meanwhile: then the same view is not the same.
        if (sample == 0 && target.settled && lightLacks(pass_run)) {
            target.settled = false;
            target.surface_number = ++surfaces_;
        }
    } catch (...) {
        recorder_.discard();
        target.samples = 0;
        throw;
    }
}

bool Drawer::beginView(Target::Impl& target, DrawList& list, const model::FrameRequest& request) {
    list.same_view = target.surface_number != 0 && target.request_surface == target.surface_number && target.request == request;
    target.request = request;
    return list.same_view && list.plan->usesGlobalLight() && takeReadyLight({device_, recorder_, pipelines_, target, list, 0});
}

bool Drawer::settle(Target::Impl& target, const DrawList& list, std::optional<std::chrono::steady_clock::time_point> until,
                    const std::atomic<bool>* cancel) {
    PassRun pass_run{device_, recorder_, pipelines_, target, list, 0, cancel};
    try {
        const bool texels_done = settleIllumination(pass_run, until);
        target.settled = settlePixelPaths(pass_run, until, path_bands_) && texels_done;
        for (const plan::PassPlan& pass : list.plan->passes) {
            if (pass.kind == plan::PassKind::kLight) run(pass_run, pass);
        }
        recorder_.submitAndWait();
    } catch (...) {
        recorder_.discard();
        throw;
    }
    return target.settled;
}

void Drawer::resolve(Target::Impl& target, const DrawList& list) {
    PassRun pass_run{device_, recorder_, pipelines_, target, list};
    for (const plan::PassPlan& pass : list.plan->passes) {
        if (pass.kind == plan::PassKind::kResolve) runResolve(pass_run, pass);
        if (pass.kind == plan::PassKind::kFxaa) runFxaa(pass_run, pass);
    }
}

void Drawer::drawBoxes(Target::Impl& target, const DrawList& list) {
    PassRun pass_run{device_, recorder_, pipelines_, target, list};
    for (const plan::PassPlan& pass : list.plan->passes) {
        if (pass.kind == plan::PassKind::kGlyphTrace) runGlyphTrace(pass_run, pass, true, trace_bands_);
        if (pass.kind == plan::PassKind::kGlyphBoxes) runGlyphBoxes(pass_run, pass, true, boxes_size_);
    }
}

}  // namespace radiata::render
