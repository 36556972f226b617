// Shadows and ambient occlusion of a plan.
#pragma once

#include <vector>

#include "plan/plan.h"

namespace radiata::plan {

/// Adds the passes of secondary rays that the scene asks for, after all layers are traced: none without a light that reaches
/// the glyphs, an effect that is on and a layer that casts. Fills in the open choices of plan.resolved.
/// \throws Error(kUnsupported) if the device cannot walk a hierarchy
void planVisibility(FramePlan& plan, const std::vector<LayerFacts>& layers, const Abilities& abilities, double rays_per_glyph);

}  // namespace radiata::plan
