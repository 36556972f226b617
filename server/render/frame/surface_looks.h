// What shading reads of isosurfaces that have a look of their own: reflection, fog, the volume that colours them.
#pragma once

#include "render/frame/pass_run.h"

namespace radiata::render {

/// Fills shader::SurfaceLook of the layers, if the plan has any such look.
void fillSurfaceLooks(gpu::Device& device, Target::Impl& target, const DrawList& list);

/// Address of shader::SurfaceLook[layers]; 0: the plan has none.
std::uint64_t surfaceLooksAddress(const Target::Impl& target, const plan::FramePlan& plan);

}  // namespace radiata::render
