// The self-test of the ways to draw fibres: a known picture by each, before it is first used.
#pragma once

#include "plan/plan.h"
#include "render/frame/drawer.h"

namespace radiata::render {

/// What the device says that it can do for fibres.
void addFibreAbilities(const gpu::Device& device, plan::Abilities& abilities);

/// Draws a lattice of fibres that zigzag towards the viewer and back, whose picture is known pixel by pixel, and compares
/// fibre, point and depth. \return whether all are right; false too if the pipeline cannot be run
bool fibletPipelineWorks(gpu::Device& device, Drawer& drawer, model::FibletPipeline pipeline, const plan::Abilities& abilities);

}  // namespace radiata::render
