// Runs the passes of a layer of fiblets: words begin as what earlier layers show, fiblets are culled and drawn into them, and
// what they won goes to the surface buffer.
#pragma once

#include "render/frame/fiblet_lines.h"

namespace radiata::render {

/// All passes of the layer, in bounded submissions.
void runFiblets(PassRun& run, const plan::PassPlan& pass, FibletPace& pace);

/// A transparent layer into the veil: its segments from the front, one per pixel and peel, until less than 1/512 of what lies
/// behind is seen. Of a moving picture (DrawList::moving) four peels, the last of which stands for all behind it, with the
/// right transparency.
void runFibletPeels(PassRun& run, const plan::PassPlan& pass, FibletPace& pace);

/// Sets the bits of fibres that are drawn through pixels, whatever hides them. \param inside  address of one bit per pixel of
/// the target, 32 to a word \param found  address of one bit per fibre
void runFibletsThrough(PassRun& run, const plan::PassPlan& pass, std::uint64_t inside, std::uint64_t found);

}  // namespace radiata::render
