// Passes of layers that are drawn as triangles.
#pragma once

#include <string>

#include "plan/plan.h"

namespace radiata::plan {

/// Whether layers are drawn as triangles instead of traced. \param quality  with its traversal chosen
inline bool isRasterised(const model::Quality& quality) {
    return quality.intersection == model::Intersection::kTessellated || quality.traversal == model::Traversal::kRasterBoxes;
}

/// \throws Error(kUnsupported) if the device draws no triangles, or for boxes with a method that does not march
void checkRaster(const model::Quality& quality, const Abilities& abilities);

/// \param shader  of a layer that is not drawn through its bands, else empty: see tensorShader()
/// \throws Error(kUnsupported) naming the layer if triangles do not draw it
void checkRasterLayer(std::size_t layer, const std::string& shader);

/// Appends the passes of one layer, up to the one that writes the surface buffer.
/// \throws Error(kResourceExhausted) naming the limit if the layer has too many triangles
void planRaster(const GlyphPlan& glyphs, const LayerFacts& facts, const std::string& suffix, int layer, FramePlan& plan);

}  // namespace radiata::plan
