// The passes of layers' second glyphs: their pole-frame tables, and how much of them lies before each pixel's surface.
#pragma once

#include "render/frame/pass_run.h"

namespace radiata::render {

/// Fills the parameters of second glyphs and makes room for them; frees it all if the plan has none. After
/// fillFrameParameters.
void fillUncertaintyParameters(gpu::Device& device, Target::Impl& target, const DrawList& list);

/// One table per second glyph with the first sample; the others use it again.
void runUncertaintyTable(PassRun& run, const plan::PassPlan& pass);

/// Adds one layer's optical depth and emission up to the surface to each pixel's medium.
void runUncertainty(PassRun& run, const plan::PassPlan& pass, BandSize& bands);

}  // namespace radiata::render
