// Light on fibres in one pass with what they won, where nobody else is in the picture (shaders/fiblet/light.comp).
#pragma once

#include "render/frame/fiblet_run.h"

namespace radiata::render {

/// Whether the pass of the fibres makes the picture, so that there is no pass of the light: they are the only layer, there is
/// one sample, nothing looks at the surface buffer, which it leaves alone.
bool lightsFibres(const PassRun& run);

/// Records the pass. \param marks  who is seen is noted for the next picture's culling \param counts  pixels that show
/// something
void lightFibres(FibletRun& layer, bool marks, bool counts);

}  // namespace radiata::render
