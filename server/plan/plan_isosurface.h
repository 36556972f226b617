// Isosurfaces of a plan.
#pragma once

#include <cstddef>

#include "plan/plan.h"

namespace radiata::plan {

/// Fills in the isovalue of layer `index`, and adds its pass if it is opaque.
/// \throws Error(kInvalidArgument) for an isovalue outside the volume's values, with their range, Error(kUnsupported) for
/// triangles where none are drawn
void planIsosurface(FramePlan& plan, std::size_t index, const LayerFacts& facts, const Abilities& abilities);

/// Whether the layer is composited over what is opaque instead of standing in the surface buffer.
bool isVeil(const model::Layer& layer);

}  // namespace radiata::plan
