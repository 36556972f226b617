#include "plan/plan.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/error.h"
#include "plan/method_plan.h"
#include "plan/plan_illumination.h"
#include "plan/plan_isosurface.h"
#include "plan/plan_peels.h"
#include "plan/plan_raster.h"
#include "plan/plan_uncertainty.h"
#include "plan/plan_visibility.h"
#include "plan/tensor_methods.h"
#include "plan/value_range.h"

namespace radiata::plan {
namespace {

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.1f", value);
    return text;
}

std::string_view name(model::Traversal traversal) {
    switch (traversal) {
        case model::Traversal::kRayQuery:
            return "ray_query";
        case model::Traversal::kBvh:
            return "bvh";
        case model::Traversal::kTiles:
            return "tiles";
        case model::Traversal::kRasterBoxes:
            return "raster_boxes";
        case model::Traversal::kAuto:
            break;
    }
    return "auto";
}

bool able(model::Traversal traversal, const Abilities& abilities) {
    switch (traversal) {
        case model::Traversal::kRayQuery:
            return abilities.ray_query;
        case model::Traversal::kBvh:
            return abilities.bvh;
        case model::Traversal::kTiles:
            return abilities.tiles;
        case model::Traversal::kRasterBoxes:
            return abilities.raster;
        case model::Traversal::kAuto:
            return true;
    }
    return false;
}

/// The traversal and why. One for the whole frame, so that layers need no structure of another kind.
model::Traversal chooseTraversal(const model::FrameRequest& request, const std::vector<LayerFacts>& layers,
                                 const Abilities& abilities, std::string& reason) {
    if (request.quality.intersection == model::Intersection::kTessellated) {
        reason = "none: deformed spheres are drawn, and no boxes are looked for";
        return model::Traversal::kAuto;
    }
    const model::Traversal wanted = request.quality.traversal;
    if (wanted != model::Traversal::kAuto) {
        if (!able(wanted, abilities)) {
            throw Error(Code::kUnsupported, "quality.traversal is " + std::string(name(wanted)) +
                                                ", which this device does not have or which failed the start-up self-test; "
                                                "the limits call lists the traversals that work");
        }
        reason = "asked for";
        return wanted;
    }
    double depth = 0;
    for (const LayerFacts& layer : layers) {
        depth += layer.depth_complexity;
        // Lists serve both kinds of glyphs of a layer or neither; the longer ones decide.
        for (const LayerFacts& second : layer.uncertainty)
            depth += std::max(0.0, second.depth_complexity - layer.depth_complexity);
    }
    if (abilities.tiles && depth <= kTileDepth) {
        reason = "about " + number(depth) + " boxes along a ray: lists per tile are short";
        return model::Traversal::kTiles;
    }
    const std::string boxes = "about " + number(depth) + " boxes along a ray; ";
    // A CPU driver walks its own hierarchy slower than ours (measured by radiata-lab run glyph-frame).
    if (abilities.ray_query && !(abilities.software && abilities.bvh)) {
        reason = boxes + "the device has ray queries";
        return model::Traversal::kRayQuery;
    }
    if (abilities.bvh) {
        reason = boxes + (abilities.ray_query ? "a CPU driver, whose ray queries are slower" : "no ray queries on this device");
        return model::Traversal::kBvh;
    }
    if (abilities.tiles) {
        reason = "nothing else passed the start-up self-test";
        return model::Traversal::kTiles;
    }
    throw Error(Code::kUnavailable, "no traversal passed the start-up self-test on this device");
}

/// What the choice of the table depends on, over all layers that can have it. One choice for the frame: what the table is
/// echoed as, on or off, must plan to the same passes again.
struct TableUse {
    double rays_per_glyph = 0;
    int band = 0;
};

TableUse tableUse(const std::vector<model::Layer>& wanted, const std::vector<LayerFacts>& layers) {
    double rays = 0, glyphs = 0;
    TableUse use;
    for (std::size_t i = 0; i < layers.size(); ++i) {
        const LayerFacts& layer = layers[i];
        if (layer.camera_close || layer.glyphs == 0) continue;
        use.band = std::max(use.band, wanted[i].glyphs().lmax.value_or(layer.layout.lmax));
        rays += layer.rays_per_glyph * static_cast<double>(layer.glyphs);
        glyphs += static_cast<double>(layer.glyphs);
    }
    if (glyphs > 0) use.rays_per_glyph = rays / glyphs;
    return use;
}

bool choosePoleTable(model::PoleTable wanted, model::Intersection method, bool tensors, const LayerFacts& layer,
                     const TableUse& use, std::string& reason) {
    if (!tensors && method != model::Intersection::kTessellated && !hasTable(method)) {
        reason = "off: the method " + std::string(model::methodName(method)) + " has no use for it";
        return false;
    }
    if (tensors) {
        reason = "off: tensors are drawn without spherical harmonics";
        return false;
    }
    if (method == model::Intersection::kTessellated) {
        reason = "off: deformed spheres are drawn, not traced";
        return false;
    }
    if (wanted == model::PoleTable::kOff) {
        reason = "off: asked for";
        return false;
    }
    if (layer.camera_close) {
        reason = "off: the camera is inside or next to a glyph";
        return false;
    }
    if (wanted == model::PoleTable::kOn) {
        reason = "on: asked for";
        return true;
    }
    if (method == model::Intersection::kRayMarchVanAlmsick) {
        reason = "on: as van Almsick et al. do";
        return true;
    }
    const bool pays = use.band >= kPoleTableBand && use.rays_per_glyph >= kPoleTableRays;
    reason = std::string(pays ? "on: " : "off: ") + "band " + std::to_string(use.band) + ", about " +
             number(use.rays_per_glyph) + " rays per glyph; it pays from band " + std::to_string(kPoleTableBand) + " and " +
             number(kPoleTableRays) + " rays";
    return pays;
}

/// Fills in what the request left open about the method.
void resolveMethod(model::Quality& quality, bool uses_table) {
    quality.pole_table = uses_table ? model::PoleTable::kOn : model::PoleTable::kOff;
    const model::Intersection method = quality.intersection;
    if (method == model::Intersection::kPoleTable && !uses_table) quality.intersection = model::Intersection::kMarch;
    if (model::byEqualSteps(method)) quality.ray_march.refinements = model::rayMarchRefinements(method, quality.ray_march);
    if (model::byPolynomial(method)) quality.polynomial.tolerance = model::polynomialTolerance(method, quality.polynomial);
}

/// Passes of the layer that writes the surface buffer first need nothing from it.
void markFirst(std::vector<PassPlan>& passes) {
    const auto writes = [](const PassPlan& pass) {
        if (pass.peeled) return false;
        return pass.kind == PassKind::kGlyphTrace || pass.kind == PassKind::kRasterSurface || pass.kind == PassKind::kFiblets ||
               pass.kind == PassKind::kIsosurfaceTrace;
    };
    const auto first = std::ranges::find_if(passes, writes);
    if (first == passes.end()) {
        passes.insert(passes.begin(), {PassKind::kClear, "clear", "clear", -1});
        return;
    }
    const int layer = first->layer;
    for (PassPlan& pass : passes) pass.first = pass.peeled || pass.layer == layer;
}

/// Ends of a colour map that the request leaves open.
model::ColourRange colourRange(const model::GlyphColour& colour, const LayerFacts& facts) {
    if (colour.range) return *colour.range;
    if (colour.mode == model::ColourMode::kRadius) {
        return {0, facts.radius_typical_mm > 0 ? static_cast<float>(facts.radius_typical_mm) : 1};
    }
    return valueRange(static_cast<float>(facts.value_min), static_cast<float>(facts.value_max));
}

}  // namespace

GlyphPlan planBands(ShLayout layout, int lmax, bool both_lobes) {
    const int limit = layout.full ? lmax : lmax - lmax % 2;
    GlyphPlan plan;
    plan.layout_name = (layout.full ? "full" : "even") + std::to_string(std::max(2, limit + limit % 2));
    plan.used = static_cast<std::uint32_t>(ShLayout{limit, layout.full}.count());
    plan.both_lobes = both_lobes;
    return plan;
}

FramePlan planFrame(const model::FrameRequest& request, const std::vector<LayerFacts>& layers, const Abilities& abilities) {
    FramePlan plan;
    plan.resolved = request;
    const model::Intersection method = request.quality.intersection;
    const model::Traversal traversal = chooseTraversal(request, layers, abilities, plan.traversal_reason);
    plan.resolved.quality.traversal = traversal;
    checkRaster(plan.resolved.quality, abilities);
    const std::string kind = traversal == model::Traversal::kRayQuery ? "query_" : "trace_";
    const bool table_asked = method == model::Intersection::kPoleTable;
    const model::PoleTable table_wanted = table_asked ? model::PoleTable::kOn : request.quality.pole_table;
    const TableUse table_use = tableUse(request.scene.layers, layers);
    plan.fiblets.resize(layers.size());
    for (std::size_t i = 0; i < layers.size(); ++i) {
        plan.layer_kinds |= 1U << request.scene.layers[i].content.index();
        if (!request.scene.layers[i].ifGlyphs()) {
            plan.glyphs.emplace_back();
            if (request.scene.layers[i].ifTracts()) planFiblets(i, layers[i], abilities, plan);
            if (request.scene.layers[i].ifSurface()) planIsosurface(plan, i, layers[i], abilities);
            continue;
        }
        const std::string where = "scene.layers[" + std::to_string(i) + "].glyphs";
        GlyphPlan glyphs = planMethod(request.quality, request.scene.layers[i].glyphs(), layers[i], abilities, where);
        std::string reason;
        const std::string tensors = tensorShader(request.scene.layers[i].glyphs(), where, layers[i].tensor_order, method);
        glyphs.pole_table = choosePoleTable(table_wanted, method, !tensors.empty(), layers[i], table_use, reason);
        if (i == 0 || glyphs.pole_table) plan.pole_table_reason = reason;
        plan.uses_pole_table = plan.uses_pole_table || glyphs.pole_table;
        plan.resolved.scene.layers[i].glyphs().lmax = request.scene.layers[i].glyphs().lmax.value_or(layers[i].layout.lmax);
        model::GlyphColour& colour = plan.resolved.scene.layers[i].glyphs().colour;
        if (colour.usesMap()) colour.range = colourRange(colour, layers[i]);
        plan.colour_modes |= 1U << static_cast<std::uint32_t>(colour.mode);
        const std::string suffix = layers.size() > 1 ? " " + std::to_string(i) : "";
        const int layer = static_cast<int>(i);
        if (glyphs.pole_table) {
            glyphs.table_floats = tableFloats(method, glyphs);
            plan.passes.push_back({PassKind::kGlyphTable, "glyph table" + suffix, tableModule(method, glyphs), layer});
        }
        const std::string drawn = tensors.empty() ? glyphs.method_module + kind + glyphs.layout_name : kind + tensors;
        if (isRasterised(plan.resolved.quality)) {
            checkRasterLayer(i, tensors);
            planRaster(glyphs, layers[i], suffix, layer, plan);
        } else {
            plan.passes.push_back({PassKind::kGlyphTrace, "glyph trace" + suffix, "glyph_" + drawn, layer});
        }
        plan.glyphs.push_back(std::move(glyphs));
    }
    resolveCulling(layers, plan);
    findPeeled(plan);
    markFirst(plan.passes);
    planPeels(plan);
    resolveMethod(plan.resolved.quality, plan.uses_pole_table);
    planVisibility(plan, layers, abilities, table_use.rays_per_glyph);
    planUncertainty(plan, layers, abilities);
    planIllumination(plan);
    plan.passes.push_back({PassKind::kLight, "light", "light", -1});
    // One sample is shown as the light pass writes it.
    if (plan.resolved.quality.samples > 1) plan.passes.push_back({PassKind::kResolve, "resolve", "resolve", -1});
    if (plan.resolved.quality.fxaa) plan.passes.push_back({PassKind::kFxaa, "fxaa", "fxaa", -1});
    return plan;
}

}  // namespace radiata::plan
