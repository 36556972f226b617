#include "plan/plan_peels.h"

#include <algorithm>
#include <bit>
#include <string>

#include "base/error.h"
#include "plan/plan_isosurface.h"
#include "shaders/shared/fiblet_draw.glsl"

namespace radiata::plan {

void findPeeled(FramePlan& plan) {
    const std::vector<model::Layer>& layers = plan.resolved.scene.layers;
    for (std::size_t i = 0; i < layers.size(); ++i) {
        const bool fibres = layers[i].ifTracts() != nullptr, glyphs = layers[i].ifGlyphs() != nullptr;
        if (layers[i].opacity >= 1 || !(fibres || (glyphs && layers.size() > 1))) continue;
        const std::string where = "scene.layers[" + std::to_string(i) + "].opacity is below 1; ";
        if (fibres && plan.resolved.quality.frozen_culling) {
            throw Error(Code::kUnsupported, where + "quality.frozen_culling shows what opaque fibres hide, so draw without it");
        }
        if (glyphs && layers[i].glyphs().uncertainty) {
            throw Error(Code::kUnsupported, where +
                                                "glyphs that show their uncertainty can be transparent only where they are "
                                                "the scene's one layer");
        }
        plan.peeled_layers |= 1U << i;
        for (PassPlan& pass : plan.passes) {
            if (!glyphs || pass.layer != static_cast<int>(i) || pass.kind == PassKind::kGlyphTable) continue;
            pass.peeled = pass.first = true;
        }
    }
    for (std::size_t i = 0; plan.peeled_layers != 0 && i < layers.size(); ++i) {
        if (isVeil(layers[i])) plan.peeled_layers |= 1U << i;
    }
}

void planPeels(FramePlan& plan) {
    if (plan.peeled_layers != 0) {
        plan.passes.push_back({PassKind::kPeels, "peel", "light", -1});
    } else if (std::ranges::any_of(plan.resolved.scene.layers, isVeil)) {
        plan.passes.push_back({PassKind::kIsosurfaceVeil, "isosurface veil", "isosurface_veil", -1});
    }
}

std::uint32_t peelSlots(std::uint64_t pixels, std::uint64_t layers, std::uint32_t wanted) {
    constexpr std::uint64_t kChainBytes = std::uint64_t{256} << 20U;
    const std::uint64_t fit = kChainBytes / sizeof(shader::ChainSlot) / std::max<std::uint64_t>(pixels * layers, 1);
    return static_cast<std::uint32_t>(std::bit_floor(std::clamp<std::uint64_t>(fit, 1, wanted)));
}

}  // namespace radiata::plan
