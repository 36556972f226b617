// Runs the passes of an opaque layer of fiblets: words begin as what earlier layers show, fiblets are culled and drawn into
// them, and what they won goes to the surface buffer.
#pragma once

#include "render/frame/fiblet_run.h"

namespace radiata::render {

/// All passes of the layer, in bounded submissions.
void runFiblets(PassRun& run, const plan::PassPlan& pass, FibletPace& pace);

}  // namespace radiata::render
