// The passes after the surface buffer: deferred lighting of one sample, and the picture as the mean of all samples.
#pragma once

#include "render/frame/pass_run.h"

namespace radiata::render {

void runLight(PassRun& run, const plan::PassPlan& pass);

/// After the last sample.
void runResolve(PassRun& run, const plan::PassPlan& pass);

}  // namespace radiata::render
