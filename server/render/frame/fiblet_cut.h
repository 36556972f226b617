// The depths of the mesh that cuts a layer of fibres pixel by pixel (shaders/fiblet/cut_depths.comp).
#pragma once

#include <string>

#include "render/fiblet/fibre_filter.h"
#include "render/frame/fiblet_buffers.h"
#include "render/frame/pass_run.h"

namespace radiata::render {

/// Finds them for the layer's view, and hands them to its parameters. \param suffix  of the pass's name
void findCutDepths(PassRun& run, const FibreFilter& filter, FibletBuffers& own, const std::string& suffix);

}  // namespace radiata::render
