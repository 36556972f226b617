#include "plan/plan_visibility.h"

#include <algorithm>
#include <cstdio>

#include "base/error.h"

namespace radiata::plan {
namespace {

/// Transparent isosurfaces are veils, through which light goes as if they were not there.
bool casts(const model::Layer& layer) {
    if (!layer.casts_shadows) return false;
    return layer.ifGlyphs() || (layer.ifSurface() && layer.opacity >= 1);
}

void chooseSunTable(VisibilityPlan& visibility, model::PoleTable wanted, double rays_per_glyph) {
    if (visibility.shadow == model::Shadow::kSoft) {
        visibility.sun_table_reason =
            "off: the rays of a soft shadow have many directions; each shaded point makes its own tables";
        return;
    }
    visibility.sun_table =
        wanted == model::PoleTable::kAuto ? rays_per_glyph >= kSunTableRays : wanted == model::PoleTable::kOn;
    visibility.sun_table_reason = visibility.sun_table ? "on: " : "off: ";
    if (wanted != model::PoleTable::kAuto) {
        visibility.sun_table_reason += "asked for";
        return;
    }
    char text[96];
    std::snprintf(text, sizeof text, "about %.1f rays per glyph; it pays from %.1f", rays_per_glyph, kSunTableRays);
    visibility.sun_table_reason += text;
}

}  // namespace

void planVisibility(FramePlan& plan, const std::vector<LayerFacts>& layers, const Abilities& abilities, double rays_per_glyph) {
    model::Scene& scene = plan.resolved.scene;
    if (scene.light.ambient_occlusion && !scene.light.ambient_occlusion->radius_mm) {
        scene.light.ambient_occlusion->radius_mm = static_cast<float>(2 * layers.front().voxel_edge_mm);
    }
    const bool casters = std::ranges::any_of(scene.layers, casts);
    const bool glyph_casters =
        std::ranges::any_of(scene.layers, [](const model::Layer& layer) { return layer.ifGlyphs() && casts(layer); });
    VisibilityPlan& visibility = plan.visibility;
    if (casters && scene.light.irradiance > 0) visibility.shadow = scene.light.shadow;
    visibility.occlusion = casters && scene.light.ambient > 0 && scene.light.ambient_occlusion.has_value();
    const bool shadow = visibility.shadow != model::Shadow::kNone;
    if (shadow && glyph_casters) chooseSunTable(visibility, plan.resolved.quality.sun_table, rays_per_glyph);
    double depth = 0;
    for (const LayerFacts& layer : layers) depth = std::max(depth, layer.sun_depth);
    // As the camera's own boxes: lists where they are short, so a frame's echo plans to the same.
    visibility.sun_tiles = glyph_casters && visibility.shadow == model::Shadow::kHard && abilities.tiles &&
                           depth <= kTileDepth && plan.resolved.quality.traversal == model::Traversal::kTiles;
    plan.resolved.quality.sun_table = visibility.sun_table ? model::PoleTable::kOn : model::PoleTable::kOff;
    if (!shadow && !visibility.occlusion) return;
    if (glyph_casters && !abilities.bvh) {
        throw Error(Code::kUnsupported,
                    "scene.light asks for shadows or ambient occlusion, whose rays walk a hierarchy; that failed the start-up "
                    "self-test on this device, so draw without them");
    }
    for (std::size_t i = 0; i < layers.size(); ++i) {
        if (!casts(scene.layers[i])) continue;
        const std::string suffix = layers.size() > 1 ? " " + std::to_string(i) : "";
        const int layer = static_cast<int>(i);
        const bool glyphs = scene.layers[i].ifGlyphs() != nullptr;
        const std::string shader = glyphs ? "glyph_visibility_" + plan.glyphs[i].layout_name : "isosurface_visibility";
        if (glyphs && visibility.sun_table) {
            plan.passes.push_back(
                {PassKind::kSunTable, "sun table" + suffix, "glyph_table_" + plan.glyphs[i].layout_name, layer});
        }
        if (shadow) plan.passes.push_back({PassKind::kShadow, "shadow" + suffix, shader, layer});
        if (visibility.occlusion) plan.passes.push_back({PassKind::kOcclusion, "occlusion" + suffix, shader, layer});
    }
}

}  // namespace radiata::plan
