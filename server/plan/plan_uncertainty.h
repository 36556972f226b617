// Uncertainty of a plan.
#pragma once

#include <vector>

#include "plan/plan.h"

namespace radiata::plan {

/// Adds the passes of the layers' second glyphs, after all layers are traced: none for layers that have none. They take lists
/// per tile or the hierarchy as the layers do, and tables where those have them; with ray queries the hierarchy, as all boxes
/// up to a depth are wanted in no order. Fills in the open extinctions of plan.resolved.
/// \throws Error(kUnsupported) if the device cannot walk a hierarchy and lists were not chosen
void planUncertainty(FramePlan& plan, const std::vector<LayerFacts>& layers, const Abilities& abilities);

}  // namespace radiata::plan
