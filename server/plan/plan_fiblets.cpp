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
    const bool from_zero = colour.mode == model::FibreColourMode::kLength || colour.mode == model::FibreColourMode::kDistance;
    const float low = from_zero ? 0 : static_cast<float>(facts.value_min);
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
    fiblets.states = layer.selected.has_value() || !layer.shown.isAll() || !layer.criteria.empty();
    fiblets.segments = facts.segments_filtered;
    fiblets.exact_width = layer.exact_width && fiblets.lines;
    fiblets.dimmed = layer.selected.has_value() && layer.unselected == model::UnselectedFibres::kDimmed;
    fiblets.cuts = static_cast<std::uint32_t>(layer.cuts.size());
    fiblets.line_width_px = layer.line_width_px;
    fiblets.tube_radius_mm = layer.tube_radius_mm.value_or(0);
    plan.fiblets[index] = fiblets;
    // What is transparent hides nothing of its own.
    if (plan.resolved.scene.layers[index].opacity < 1) {
        if (fiblets.culling == model::FibletCulling::kTwoPhase) plan.fiblets[index]->culling = model::FibletCulling::kFrustum;
        return;
    }
    const std::string suffix = plan.fiblets.size() > 1 ? " " + std::to_string(index) : "";
    plan.passes.push_back({PassKind::kFiblets, "fiblet raster" + suffix, "fiblet_raster", static_cast<int>(index)});
}

void planPeels(FramePlan& plan) {
    const std::vector<model::Layer>& layers = plan.resolved.scene.layers;
    const bool veil = plan.usesVeil();
    for (std::size_t i = 0; i < layers.size(); ++i) {
        if (!layers[i].ifTracts() || layers[i].opacity >= 1) continue;
        const std::string where = "scene.layers[" + std::to_string(i) + "].opacity is below 1; ";
        if (veil || plan.usesPeels()) {
            throw Error(Code::kUnsupported, where +
                                                "one layer of fibres of a scene can be transparent, and none beside a "
                                                "transparent isosurface");
        }
        if (plan.resolved.quality.frozen_culling) {
            throw Error(Code::kUnsupported, where + "quality.frozen_culling shows what opaque fibres hide, so draw without it");
        }
        const std::string suffix = layers.size() > 1 ? " " + std::to_string(i) : "";
        plan.passes.push_back({PassKind::kFibletPeels, "fiblet peel" + suffix, "fiblet_raster", static_cast<int>(i)});
    }
}

}  // namespace radiata::plan
