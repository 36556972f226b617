// Global light in a frame's plan: a pass for each opaque isosurface of a scene that asks for it, and none for any other
// scene.
#pragma once

#include "plan/plan.h"

namespace radiata::plan {

void planIllumination(FramePlan& plan);

}  // namespace radiata::plan
