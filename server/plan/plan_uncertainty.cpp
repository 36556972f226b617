#include "plan/plan_uncertainty.h"

#include <algorithm>
#include <string>

#include "base/error.h"

namespace radiata::plan {

void planUncertainty(FramePlan& plan, const std::vector<LayerFacts>& layers, const Abilities& abilities) {
    plan.uncertainty.resize(layers.size());
    for (std::size_t i = 0; i < layers.size(); ++i) {
        if (!plan.resolved.scene.layers[i].ifGlyphs()) continue;
        model::GlyphLayer& layer = plan.resolved.scene.layers[i].glyphs();
        if (!layer.uncertainty) continue;
        if (layers[i].uncertainty.empty()) {
            throw Error(Code::kInternal, "layer " + std::to_string(i) + " was prepared without its uncertainty");
        }
        const LayerFacts& facts = layers[i].uncertainty.front();
        if (plan.resolved.quality.traversal != model::Traversal::kTiles && !abilities.bvh) {
            throw Error(Code::kUnsupported,
                        "scene.layers[" + std::to_string(i) +
                            "].glyphs.uncertainty needs the hierarchy, which failed this device's start-up self-test; "
                            "quality.traversal tiles does without");
        }
        const int lmax = layer.lmax ? std::min(*layer.lmax, facts.layout.lmax) : facts.layout.lmax;
        GlyphPlan glyphs = planBands(facts.layout, lmax, layer.negative_lobes == model::NegativeLobes::kShown);
        glyphs.pole_table = plan.uses_pole_table && !facts.camera_close && facts.glyphs > 0;
        const std::string suffix = layers.size() > 1 ? " " + std::to_string(i) : "";
        const int index = static_cast<int>(i);
        if (glyphs.pole_table) {
            plan.passes.push_back(
                {PassKind::kUncertaintyTable, "uncertainty table" + suffix, "glyph_table_" + glyphs.layout_name, index});
        }
        plan.passes.push_back(
            {PassKind::kUncertainty, "uncertainty" + suffix, "glyph_uncertainty_" + glyphs.layout_name, index});
        plan.uncertainty[i] = std::move(glyphs);
        // An eighth is seen of what lies behind half a voxel of it.
        if (!layer.uncertainty->extinction_per_mm) {
            layer.uncertainty->extinction_per_mm = static_cast<float>(2 / (0.5 * layers[i].voxel_edge_mm));
        }
    }
}

}  // namespace radiata::plan
