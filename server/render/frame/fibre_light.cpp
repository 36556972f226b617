#include "render/frame/fibre_light.h"

#include <algorithm>

#include "render/frame/light_passes.h"

namespace radiata::render {
namespace {

constexpr std::size_t kPagedConstant = 15;  ///< of fibre_colour.glsl

struct LightPush {
    std::uint64_t layer, frame, looks, picture, counters;
};

}  // namespace

bool lightsFibres(const PassRun& run) {
    const plan::FramePlan& plan = *run.list.plan;
    const auto fits = [](const plan::PassPlan& pass) {
        return (pass.kind == plan::PassKind::kFiblets && !pass.peeled) || pass.kind == plan::PassKind::kLight ||
               pass.kind == plan::PassKind::kFxaa;
    };
    return run.list.picture_only && run.list.layers.size() == 1 && run.list.layers[0].tracts &&
           std::ranges::all_of(plan.passes, fits) && !plan.fibre_occlusion && !plan.fibre_halos;
}

void lightFibres(FibletRun& layer, bool marks, bool counts) {
    PassRun& run = layer.run;
    std::vector<std::uint32_t> constants{PassRun::kGroup,
                                         marks ? 1U : 0U,
                                         run.list.plan->colour_modes,
                                         layer.plan.tubes ? 1U : 0U,
                                         0U,  // no constant
                                         run.list.plan->fibre_colours};
    if (run.list.plan->paged_layers != 0) {
        constants.resize(kPagedConstant, 0U);
        constants.push_back(run.list.plan->paged_layers);
    }
    run.recorder.dispatch(
        run.pipelines.get("fiblet_light", constants), "fiblet light", PassRun::groups(run.pixels()), 1, 1,
        LightPush{layer.own.layerAddress(), run.frameAddress(), run.frameAddress() + Target::Impl::kLookOffset,
                  pictureAddress(run), counts ? run.counterAddress() : 0});
}

}  // namespace radiata::render
