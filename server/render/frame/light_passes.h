// The passes after the surface buffer: deferred lighting of one sample, and the picture as the mean of all samples.
#pragma once

#include "render/frame/pass_run.h"

namespace radiata::render {

/// Where the picture goes, before FXAA if it is smoothed.
std::uint64_t pictureAddress(PassRun& run);

void runLight(PassRun& run, const plan::PassPlan& pass);

/// Composes what the peel surface shows of transparent layers into the veil. \param peel  address of shader::PeelParams
/// \param kinds  of layers that are peeled: bit 1 << index of model::Layer::content
/// \param first  the veil is empty \param tail  what is shown stands for all behind it
void runPeelLight(PassRun& run, std::uint64_t peel, std::uint32_t kinds, bool first, bool tail);

/// After the last sample.
void runResolve(PassRun& run, const plan::PassPlan& pass);

/// The same; smooths a picture of one sample, others are left alone.
void runFxaa(PassRun& run, const plan::PassPlan& pass);

}  // namespace radiata::render
