// What of a drawn picture goes to the host: its bytes, and the lossless outputs, which are the surface buffer of the first
// sample turned into arrays in double on the CPU.
#pragma once

#include "model/frame.h"
#include "render/frame/drawer.h"

namespace radiata::render {

/// Reads the surface buffer back and fills the wanted arrays. \throws Error of the device
void readOutputs(gpu::Device& device, Drawer& drawer, Target::Impl& target, const DrawList& list, const model::Outputs& wanted,
                 model::FramePixels& pixels);

/// The resolved picture, row by row.
void copyPicture(const Target::Impl& target, model::FramePixels& pixels);

}  // namespace radiata::render
