// Global light of isosurfaces: texels that the pixels need, and their light for each pixel. See render/light/lattice.h.
#pragma once

#include <chrono>
#include <optional>

#include "render/frame/pass_run.h"

namespace radiata::render {

/// What the lattice's own passes run with.
LatticeRun latticeRun(const PassRun& run);

/// Light of the layer's pixels. Where texels are lacking they are asked for: of a picture that is not settled each gets its
/// first samples, else all that it takes.
void runIllumination(PassRun& run, const plan::PassPlan& pass);

/// Whether the latest request of each of the picture's lattices was for its surface buffer, and its texels are done, so that
/// nothing needs to be asked for once more.
bool takeReadyLight(const PassRun& run);
/// Whether a pixel lacked texels after all, as far as there is room for them.
bool lightLacks(const PassRun& run);

/// Goes on with the texels of the picture's first sample, whose surface buffer must still be there, and lights its pixels by
/// them. \return whether all are as exact as asked for  \throws Error(kCancelled); the picture's first sample stays
bool settleIllumination(PassRun& run, std::optional<std::chrono::steady_clock::time_point> until);

/// Sums over layers; paths and time of all the picture's samples, texels of the latest.
model::IlluminationInfo illuminationInfo(const Target::Impl& target, const DrawList& list);

}  // namespace radiata::render
