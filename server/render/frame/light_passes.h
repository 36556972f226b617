// The passes after the surface buffer: deferred lighting of one sample, and the picture as the mean of all samples.
#pragma once

#include "render/frame/pass_run.h"

namespace radiata::render {

void runLight(PassRun& run, const plan::PassPlan& pass);

/// Composes what the peel surface shows of a transparent layer of fibres into the veil. \param layer  address of its parameters
/// \param first  the veil is empty \param tail  the segments shown stand for all behind them
void runPeelLight(PassRun& run, const std::string& name, std::uint64_t layer, bool first, bool tail);

/// After the last sample.
void runResolve(PassRun& run, const plan::PassPlan& pass);

/// The same; smooths a picture of one sample, others are left alone.
void runFxaa(PassRun& run, const plan::PassPlan& pass);

}  // namespace radiata::render
