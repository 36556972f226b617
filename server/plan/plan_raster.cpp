#include "plan/plan_raster.h"

#include "base/error.h"

namespace radiata::plan {

void checkRaster(const model::Quality& quality, const Abilities& abilities) {
    if (quality.intersection == model::Intersection::kTessellated && !abilities.raster) {
        throw Error(Code::kUnsupported,
                    "quality.intersection is tessellated, but this device draws no triangles or failed the "
                    "start-up self-test of drawing; use march");
    }
    if (quality.traversal == model::Traversal::kRasterBoxes && quality.intersection != model::Intersection::kMarch) {
        throw Error(Code::kUnsupported,
                    "quality.traversal is raster_boxes, whose fragments march; quality.intersection must be march with it");
    }
}

void checkRasterLayer(std::size_t layer, const std::string& shader) {
    if (shader.empty()) return;
    throw Error(Code::kUnsupported, "scene.layers[" + std::to_string(layer) + "] shows " +
                                        (shader == "ellipsoid" ? "ellipsoids" : "tensors themselves") +
                                        ", which are traced only; leave quality.traversal open and use march");
}

void planRaster(const GlyphPlan& glyphs, const LayerFacts& facts, const std::string& suffix, int layer, FramePlan& plan) {
    const model::Quality& quality = plan.resolved.quality;
    if (quality.intersection == model::Intersection::kTessellated) {
        const std::uint64_t triangles = model::meshTriangles(quality.tessellation.mesh, quality.tessellation.level);
        if (facts.glyphs > model::kLayerTrianglesMax / triangles) {
            throw Error(Code::kResourceExhausted, "quality.tessellation: " + std::to_string(facts.glyphs) + " glyphs of " +
                                                      std::to_string(triangles) + " triangles are more than the " +
                                                      std::to_string(model::kLayerTrianglesMax) +
                                                      " that are drawn per layer; lower the level or show fewer glyphs");
        }
        plan.passes.push_back(
            {PassKind::kGlyphTessellate, "glyph tessellate" + suffix, "glyph_tessellate_" + glyphs.layout_name, layer});
        plan.passes.push_back({PassKind::kGlyphMesh, "glyph mesh" + suffix, "glyph_mesh", layer});
    } else {
        plan.passes.push_back({PassKind::kGlyphBoxes, "glyph boxes" + suffix, "glyph_boxes_" + glyphs.layout_name, layer});
    }
    plan.passes.push_back({PassKind::kRasterSurface, "glyph surface" + suffix, "raster_surface", layer});
}

}  // namespace radiata::plan
