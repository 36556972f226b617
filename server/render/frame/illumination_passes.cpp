#include "render/frame/illumination_passes.h"

#include <algorithm>

#include "gpu/device.h"
#include "render/frame/isosurface_passes.h"

namespace radiata::render {
namespace {

IlluminationLattice& latticeOf(const DrawList& list, int layer, bool settled) {
    const DrawnLayer& drawn = list.layers[static_cast<std::size_t>(layer)];
    return *(settled && drawn.rest_lattice ? drawn.rest_lattice : drawn.lattice);
}

IlluminationLattice& latticeOf(const DrawList& list, int layer) { return latticeOf(list, layer, list.settled); }

LatticePixels pixelsOf(const PassRun& run, int layer) {
    return {run.frameAddress(), isosurfaceAddress(run.target, static_cast<std::size_t>(layer)), run.target.surface.address(),
            static_cast<std::uint32_t>(run.pixels())};
}

void gatherLight(PassRun& run, IlluminationLattice& lattice, int layer) {
    ensureBytes(run.device, run.target.global_light, run.pixels() * sizeof(glm::vec3), gpu::Memory::kDevice, "global light");
    lattice.gather(latticeRun(run), pixelsOf(run, layer), run.target.global_light.address(), "global light", run.list.settled);
}

using Until = std::optional<std::chrono::steady_clock::time_point>;

bool lightNeeded(PassRun& run, IlluminationLattice& lattice, int layer, Until until) {
    // Other views may have asked for their own texels meanwhile.
    if (lattice.requestedFor() != run.target.surface_number) {
        lattice.request(latticeRun(run), pixelsOf(run, layer), run.target.surface_number);
    }
    return lattice.refine(latticeRun(run), until);
}

/// What the picture needs comes first.
bool lightWhole(PassRun& run, IlluminationLattice& lattice, int layer, Until until) {
    if (lattice.whole()) return true;
    if (!lattice.requestedWhole() && !lightNeeded(run, lattice, layer, until)) return false;
    return lattice.lightAll(latticeRun(run), until);
}

}  // namespace

LatticeRun latticeRun(const PassRun& run) {
    return {run.device, run.recorder,
            [&pipelines = run.pipelines](const std::string& shader, const std::vector<std::uint32_t>& constants)
                -> const gpu::ComputePipeline& { return pipelines.get(shader, constants); },
            run.cancel, &run.target.light_spent};
}

void runIllumination(PassRun& run, const plan::PassPlan& pass) {
    IlluminationLattice& lattice = latticeOf(run.list, pass.layer);
    const LatticeRun lattice_run = latticeRun(run);
    // Mostly everything is there: then the pixels' light is, too.
    gatherLight(run, lattice, pass.layer);
    if (run.sample == 0 && run.target.settled) return;
    run.recorder.submitAndWait();
    if (!lattice.lacking()) return;
    lattice.request(lattice_run, pixelsOf(run, pass.layer), 0);
    if (run.list.settled) {
        lattice.refine(lattice_run, {});
    } else {
        lattice.lightFirst(lattice_run);
    }
    gatherLight(run, lattice, pass.layer);
}

bool takeReadyLight(const PassRun& run) {
    for (const plan::PassPlan& pass : run.list.plan->passes) {
        if (pass.kind == plan::PassKind::kPixelPaths) return false;
        if (pass.kind != plan::PassKind::kIllumination) continue;
        const IlluminationLattice& lattice = latticeOf(run.list, pass.layer, true);
        if (lattice.requestedFor() != run.target.surface_number || !lattice.done()) return false;
    }
    return true;
}

bool lightLacks(const PassRun& run) {
    for (const plan::PassPlan& pass : run.list.plan->passes) {
        if (pass.kind != plan::PassKind::kIllumination) continue;
        const IlluminationLattice& lattice = latticeOf(run.list, pass.layer);
        if (lattice.lacking() && !lattice.beyondBudget()) return true;
    }
    return false;
}

bool settleIllumination(PassRun& run, std::optional<std::chrono::steady_clock::time_point> until) {
    const LatticeRun lattice_run = latticeRun(run);
    bool done = true;
    for (const plan::PassPlan& pass : run.list.plan->passes) {
        if (pass.kind != plan::PassKind::kIllumination) continue;
        IlluminationLattice& lattice = latticeOf(run.list, pass.layer);
        done = (run.list.plan->resolved.scene.light.illumination->full ? lightWhole(run, lattice, pass.layer, until)
                                                                       : lightNeeded(run, lattice, pass.layer, until)) &&
               done;
        gatherLight(run, lattice, pass.layer);
    }
    return done;
}

model::IlluminationInfo illuminationInfo(const Target::Impl& target, const DrawList& list) {
    model::IlluminationInfo sum;
    sum.samples = target.light_spent.samples;
    sum.seconds = target.light_spent.seconds;
    double known = 0;
    for (std::size_t i = 0; i < list.layers.size(); ++i) {
        if (!list.layers[i].lattice) continue;
        const model::IlluminationInfo one = latticeOf(list, static_cast<int>(i)).info();
        const auto weight = static_cast<double>(one.texels_needed);
        sum.texels += one.texels;
        sum.texels_needed += one.texels_needed;
        sum.texels_done += one.texels_done;
        sum.texels_out_of_samples += one.texels_out_of_samples;
        sum.bricks_left_out += one.bricks_left_out;
        sum.bytes += one.bytes;
        sum.payload_bytes += one.payload_bytes;
        sum.texels_read += one.texels_read;
        if (!one.saved.empty()) sum.saved += (sum.saved.empty() ? "" : "; ") + one.saved;
        sum.mean_error = known + weight > 0 ? (known * sum.mean_error + weight * one.mean_error) / (known + weight) : 0;
        sum.p95_error = std::max(sum.p95_error, one.p95_error);
        sum.projected = sum.projected || one.projected;
        known += weight;
    }
    return sum;
}

}  // namespace radiata::render
