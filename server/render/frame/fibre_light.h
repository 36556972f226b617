// Light on fibres in one pass with what they won, where nobody else is in the picture (shaders/fiblet/light.comp).
#pragma once

#include "render/frame/fiblet_buffers.h"
#include "render/frame/pass_run.h"

namespace radiata::render {

/// Whether the pass of the fibres makes the picture, so that there is no pass of the light: they are the only layer, there is
/// one sample, nothing looks at the surface buffer, which it leaves alone.
bool lightsFibres(const PassRun& run);

/// Records the pass. \param marks  who is seen is noted for the next picture's culling \param again  pixels were counted before
void lightFibres(PassRun& run, const plan::FibletPlan& plan, const FibletBuffers& own, bool marks, bool again);

}  // namespace radiata::render
