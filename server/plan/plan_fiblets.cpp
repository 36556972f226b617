#include "plan/plan_fiblets.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "plan/plan.h"

namespace radiata::plan {
namespace {

/// Ends of a colour map that the request leaves open.
model::FibreColourRange fibreRange(const model::FibreColour& colour, const LayerFacts& facts) {
    if (colour.range) return *colour.range;
    const float low = colour.mode == model::FibreColourMode::kLength ? 0 : static_cast<float>(facts.value_min);
    const auto high = static_cast<float>(facts.value_max);
    if (low < high && std::isfinite(high - low)) return {low, high};
    return {low, low + std::max(1.0F, std::abs(low))};
}

}  // namespace

void planFiblets(std::size_t index, const LayerFacts& facts, const Abilities& abilities, FramePlan& plan) {
    if (!abilities.int64_atomics) {
        throw Error(Code::kUnsupported, "scene.layers[" + std::to_string(index) +
                                            "].tractogram needs 64-bit atomics in buffers, which this device lacks");
    }
    model::TractogramLayer& layer = plan.resolved.scene.layers[index].tracts();
    if (layer.colour.usesMap()) layer.colour.range = fibreRange(layer.colour, facts);
    plan.fibre_colours |= 1U << static_cast<std::uint32_t>(layer.colour.mode);
    plan.fibre_occlusion = plan.fibre_occlusion || layer.occlusion_px.has_value();
    plan.fibre_halos = plan.fibre_halos || layer.halo_px.has_value();
    FibletPlan fiblets;
    fiblets.culling = plan.resolved.quality.fiblet_culling;
    fiblets.tubes = layer.tube_radius_mm.has_value();
    fiblets.selected_only = fiblets.tubes && layer.selected.has_value();
    fiblets.lines = !fiblets.tubes || fiblets.selected_only;
    fiblets.states = layer.selected.has_value() || !layer.shown.isAll();
    fiblets.dimmed = layer.selected.has_value() && layer.unselected == model::UnselectedFibres::kDimmed;
    fiblets.cuts = static_cast<std::uint32_t>(layer.cuts.size());
    fiblets.line_width_px = layer.line_width_px;
    fiblets.tube_radius_mm = layer.tube_radius_mm.value_or(0);
    fiblets.detail_px = plan.resolved.quality.fiblet_detail_px.value_or(0);
    plan.fiblets[index] = fiblets;
    const std::string suffix = plan.fiblets.size() > 1 ? " " + std::to_string(index) : "";
    plan.passes.push_back({PassKind::kFiblets, "fiblet raster" + suffix, "fiblet_raster", static_cast<int>(index)});
}

}  // namespace radiata::plan
