#include "render/frame/uncertainty_passes.h"

#include "gpu/device.h"
#include "render/frame/frame_parameters.h"

namespace radiata::render {
namespace {

struct TablePush {
    std::uint64_t frame, layer;
};
struct UncertaintyPush {
    std::uint64_t frame, uncertainty, surface, media, counters;
    std::uint32_t first_block_row;
};

shader::UncertaintyParams& paramsOf(const Target::Impl& target, std::size_t layer) {
    return target.uncertainty.params.as<shader::UncertaintyParams>()[layer];
}

std::uint64_t addressOf(const Target::Impl& target, std::size_t layer) {
    return target.uncertainty.params.address() + layer * sizeof(shader::UncertaintyParams);
}

/// Whether no earlier pass of the plan has written the media.
bool firstUncertainty(const plan::FramePlan& plan, const plan::PassPlan& pass) {
    const auto first = std::ranges::find(plan.passes, plan::PassKind::kUncertainty, &plan::PassPlan::kind);
    return &*first == &pass;
}

}  // namespace

void fillUncertaintyParameters(gpu::Device& device, Target::Impl& target, const DrawList& list) {
    UncertaintyBuffers& buffers = target.uncertainty;
    if (!list.plan->usesUncertainty()) {
        buffers = {};
        return;
    }
    const std::size_t count = list.layers.size();
    buffers.layers.resize(count);
    ensureBytes(device, buffers.params, count * sizeof(shader::UncertaintyParams), gpu::Memory::kUpload,
                "uncertainty parameters");
    const auto pixels = static_cast<std::uint64_t>(target.width) * static_cast<std::uint64_t>(target.height);
    ensureBytes(device, buffers.media, pixels * sizeof(shader::Medium), gpu::Memory::kDevice, "media");
    // Ray queries find nearest hits; all boxes up to a depth are found by the hierarchy.
    const bool tiles = list.plan->resolved.quality.traversal == model::Traversal::kTiles;
    for (std::size_t i = 0; i < count; ++i) {
        const std::optional<plan::GlyphPlan>& glyphs = list.plan->uncertainty[i];
        if (!glyphs) continue;
        const model::Uncertainty& settings = *list.plan->resolved.scene.layers[i].glyphs().uncertainty;
        shader::UncertaintyParams params{};
        params.glyphs = glyphParameters(device, target, buffers.layers[i], *list.layers[i].glyphs->uncertain(), *glyphs,
                                        tiles ? model::Traversal::kTiles : model::Traversal::kBvh, target.frame());
        params.glyphs.layer = static_cast<std::uint32_t>(i);
        params.emission = settings.emission;
        params.extinction = *settings.extinction_per_mm;
        paramsOf(target, i) = params;
    }
}

void runUncertaintyTable(PassRun& run, const plan::PassPlan& pass) {
    const auto layer = static_cast<std::size_t>(pass.layer);
    const std::uint32_t count = paramsOf(run.target, layer).glyphs.count;
    if (run.sample > 0 || count == 0) return;
    const std::uint32_t used = run.list.plan->uncertainty[layer]->used;
    run.recorder.dispatch(run.pipelines.get(pass.shader, {PassRun::kGroup, 0U, 0U, 0U, used}), pass.name,
                          PassRun::groups(count), 1, 1, TablePush{run.frameAddress(), addressOf(run.target, layer)});
}

void runUncertainty(PassRun& run, const plan::PassPlan& pass, BandSize& bands) {
    const auto layer = static_cast<std::size_t>(pass.layer);
    const plan::GlyphPlan& glyphs = *run.list.plan->uncertainty[layer];
    const bool tiles = run.list.plan->resolved.quality.traversal == model::Traversal::kTiles;
    const bool first = firstUncertainty(*run.list.plan, pass);
    const gpu::ComputePipeline& pipeline = run.pipelines.get(
        pass.shader, {PassRun::kGroup, tiles ? 1U : 0U, glyphs.pole_table ? 1U : 0U, glyphs.both_lobes ? 1U : 0U, glyphs.used,
                      first ? 1U : 0U, 0U, kTileShiftX, kTileShiftY});
    run.dispatchBands(pipeline, pass.name,
                      UncertaintyPush{run.frameAddress(), addressOf(run.target, layer), run.target.surface.address(),
                                      run.target.uncertainty.media.address(), run.counterAddress(), 0},
                      bands);
}

}  // namespace radiata::render
