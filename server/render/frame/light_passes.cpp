#include "render/frame/light_passes.h"

namespace radiata::render {
namespace {

struct LightPush {
    std::uint64_t frame, surface, light, looks;
};
struct ResolvePush {
    std::uint64_t light, picture;
    std::uint32_t pixels, samples;
};

}  // namespace

void runLight(PassRun& run, const plan::PassPlan& pass) {
    const Target::Impl& target = run.target;
    run.recorder.dispatch(
        run.pipelines.get(pass.shader, {PassRun::kGroup, run.sample == 0 ? 1U : 0U, run.list.plan->colour_modes}), pass.name,
        PassRun::groups(run.pixels()), 1, 1,
        LightPush{run.frameAddress(), target.surface.address(), target.light.address(),
                  run.frameAddress() + Target::Impl::kLookOffset});
}

void runResolve(PassRun& run, const plan::PassPlan& pass) {
    const Target::Impl& target = run.target;
    run.recorder.dispatch(run.pipelines.get(pass.shader, {PassRun::kGroup}), pass.name, PassRun::groups(run.pixels()), 1, 1,
                          ResolvePush{target.light.address(), target.picture.address(),
                                      static_cast<std::uint32_t>(run.pixels()), static_cast<std::uint32_t>(target.samples)});
    run.recorder.submitAndWait();
}

}  // namespace radiata::render
