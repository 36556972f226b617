#include "render/frame/light_passes.h"

#include <algorithm>

#include "render/frame/surface_looks.h"
#include "render/frame/visibility_passes.h"

namespace radiata::render {
namespace {

constexpr std::size_t kPagedConstant = 15;  ///< of light.comp

struct LightPush {
    std::uint64_t frame, surface, light, looks, shadow_bits, occlusion_bits, media, veil, global_light, surface_looks, peel,
        picture;
};
struct ResolvePush {
    std::uint64_t light, picture;
    std::uint32_t pixels, samples;
};

struct FxaaPush {
    std::uint64_t source, picture;
    int width, height;
};

/// Of one sample the light is not summed up: it is the picture.
bool makesPicture(const plan::FramePlan& plan) {
    return std::ranges::none_of(plan.passes, [](const plan::PassPlan& pass) { return pass.kind == plan::PassKind::kResolve; });
}

/// FXAA is for pictures of one sample; more of them smooth edges better.
bool smooths(const PassRun& run) { return run.list.plan->resolved.quality.fxaa && run.target.samples <= 1; }

}  // namespace

std::uint64_t pictureAddress(PassRun& run) {
    Target::Impl& target = run.target;
    if (!smooths(run)) return target.picture.address();
    ensureBytes(run.device, target.fxaa_source, 4 * run.pixels(), gpu::Memory::kDevice, "picture before FXAA");
    return target.fxaa_source.address();
}

void runLight(PassRun& run, const plan::PassPlan& pass) {
    Target::Impl& target = run.target;
    const bool picture = makesPicture(*run.list.plan);
    if (!picture && !target.light)
        target.light = gpu::Buffer(run.device, run.pixels() * 12, gpu::Memory::kDevice, "light buffer");
    const plan::VisibilityPlan& visibility = run.list.plan->visibility;
    const bool media = run.list.plan->usesUncertainty(), veil = run.list.plan->usesVeil();
    const bool global = run.list.plan->usesGlobalLight();
    std::vector<std::uint32_t> constants{PassRun::kGroup,
                                         run.sample == 0 ? 1U : 0U,
                                         run.list.plan->colour_modes,
                                         media ? 1U : 0U,
                                         run.list.plan->layer_kinds,
                                         run.list.plan->fibre_colours,
                                         veil ? 1U : 0U,
                                         run.list.plan->fibre_occlusion ? 1U : 0U,
                                         run.list.plan->fibre_halos ? 1U : 0U,
                                         global ? 1U : 0U,
                                         run.list.plan->surface_looks,
                                         0U,
                                         0U,
                                         picture ? 1U : 0U,
                                         run.list.layers.size() == 1 ? 1U : 0U};
    if (run.list.plan->paged_layers != 0) {
        constants.resize(kPagedConstant, 0U);
        constants.push_back(run.list.plan->paged_layers);
    }
    addVisibilityConstants(*run.list.plan, constants);
    const std::uint64_t shadow_bits = visibility.shadow != model::Shadow::kNone ? target.shadow_bits.address() : 0;
    const std::uint64_t occlusion_bits = visibility.occlusion ? target.occlusion_bits.address() : 0;
    run.recorder.dispatch(run.pipelines.get(pass.shader, constants), pass.name, PassRun::groups(run.pixels()), 1, 1,
                          LightPush{run.frameAddress(), target.surface.address(), picture ? 0 : target.light.address(),
                                    run.frameAddress() + Target::Impl::kLookOffset, shadow_bits, occlusion_bits,
                                    media ? target.uncertainty.media.address() : 0, veil ? target.veil.address() : 0,
                                    global ? target.global_light.address() : 0, surfaceLooksAddress(target, *run.list.plan), 0,
                                    picture ? pictureAddress(run) : 0});
}

void runPeelLight(PassRun& run, std::uint64_t peel, std::uint32_t kinds, bool first, bool tail) {
    const Target::Impl& target = run.target;
    const plan::FramePlan& plan = *run.list.plan;
    std::vector<std::uint32_t> constants{PassRun::kGroup,
                                         first ? 1U : 0U,
                                         plan.colour_modes,
                                         0U,
                                         kinds,
                                         plan.fibre_colours,
                                         0U,
                                         plan.fibre_occlusion ? 1U : 0U,
                                         plan.fibre_halos ? 1U : 0U,
                                         0U,
                                         plan.surface_looks,
                                         1U,
                                         tail ? 1U : 0U};
    if (plan.paged_layers != 0) {
        constants.resize(kPagedConstant, 0U);
        constants.push_back(plan.paged_layers);
    }
    run.recorder.dispatch(
        run.pipelines.get("light", constants), "peel", PassRun::groups(run.pixels()), 1, 1,
        LightPush{run.frameAddress(), target.peel_surface.address(), 0, run.frameAddress() + Target::Impl::kLookOffset, 0, 0, 0,
                  target.veil.address(), 0, surfaceLooksAddress(target, plan), peel, 0});
}

void runResolve(PassRun& run, const plan::PassPlan& pass) {
    const Target::Impl& target = run.target;
    run.recorder.dispatch(run.pipelines.get(pass.shader, {PassRun::kGroup}), pass.name, PassRun::groups(run.pixels()), 1, 1,
                          ResolvePush{target.light.address(), pictureAddress(run), static_cast<std::uint32_t>(run.pixels()),
                                      static_cast<std::uint32_t>(target.samples)});
    run.recorder.submitAndWait();
}

void runFxaa(PassRun& run, const plan::PassPlan& pass) {
    const Target::Impl& target = run.target;
    if (!smooths(run)) return;
    run.recorder.dispatch(run.pipelines.get(pass.shader, {PassRun::kGroup}), pass.name, PassRun::groups(run.pixels()), 1, 1,
                          FxaaPush{target.fxaa_source.address(), target.picture.address(), target.width, target.height});
    run.recorder.submitAndWait();
}

}  // namespace radiata::render
