#include "plan/plan_isosurface.h"

#include <algorithm>
#include <cstdio>

#include "base/error.h"

namespace radiata::plan {
namespace {

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%g", value);
    return text;
}

}  // namespace

bool isVeil(const model::Layer& layer) { return layer.ifSurface() && layer.opacity < 1; }

void planIsosurface(FramePlan& plan, std::size_t index, const LayerFacts& facts) {
    model::Layer& layer = plan.resolved.scene.layers[index];
    model::IsosurfaceLayer& surface = layer.surface();
    const float isovalue = surface.isovalue.value_or(static_cast<float>(facts.value_split));
    if (!(isovalue >= facts.value_min && isovalue <= facts.value_max)) {
        throw Error(Code::kInvalidArgument, "scene.layers[" + std::to_string(index) + "].isosurface.isovalue is " +
                                                number(isovalue) + "; '" + surface.dataset_id + "' has values from " +
                                                number(facts.value_min) + " to " + number(facts.value_max));
    }
    surface.isovalue = isovalue;
    plan.colour_modes |= 1U << static_cast<std::uint32_t>(model::ColourMode::kUniform);
    if (isVeil(layer)) return;
    const std::string suffix = plan.resolved.scene.layers.size() > 1 ? " " + std::to_string(index) : "";
    plan.passes.push_back(
        {PassKind::kIsosurfaceTrace, "isosurface trace" + suffix, "isosurface_trace", static_cast<int>(index)});
}

void planVeil(FramePlan& plan) {
    if (std::ranges::none_of(plan.resolved.scene.layers, isVeil)) return;
    plan.passes.push_back({PassKind::kIsosurfaceVeil, "isosurface veil", "isosurface_veil", -1});
}

}  // namespace radiata::plan
