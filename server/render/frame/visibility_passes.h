// The passes of secondary rays: tables for the light's direction, and the bits of rays that glyphs block.
#pragma once

#include "render/frame/pass_run.h"

namespace radiata::render {

/// Fills the parameters of secondary rays and makes room for what the plan's rays need, and for nothing else. After
/// fillFrameParameters.
void fillVisibilityParameters(gpu::Device& device, Target::Impl& target, const DrawList& list);

/// Appends what shaders/common/light_visibility.glsl is specialised by; nothing if the plan has no secondary rays.
void addVisibilityConstants(const plan::FramePlan& plan, std::vector<std::uint32_t>& constants);

/// One table per glyph for rays towards the light, with the first sample; the others use it again.
void runSunTable(PassRun& run, const plan::PassPlan& pass);

/// Casts each shaded pixel's rays at one layer and adds their bits: towards the light (PassKind::kShadow) or all around
/// (kOcclusion).
void runVisibility(PassRun& run, const plan::PassPlan& pass, BandSize& bands);

}  // namespace radiata::render
