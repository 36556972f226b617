// The lossless outputs: the surface buffer of the first sample, turned into arrays in double on the CPU.
#pragma once

#include "model/frame.h"
#include "render/frame/drawer.h"

namespace radiata::render {

/// Reads the surface buffer back and fills the wanted arrays. \throws Error of the device
void readOutputs(gpu::Device& device, Drawer& drawer, Target::Impl& target, const DrawList& list, const model::Outputs& wanted,
                 model::FramePixels& pixels);

}  // namespace radiata::render
