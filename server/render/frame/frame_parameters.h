// What the passes read about a frame and its layers, for the camera of the first sample.
#pragma once

#include "render/frame/colour_tables.h"
#include "render/frame/pass_run.h"

namespace radiata::render {

/// Pixels per tile of the lists, log2.
constexpr int kTileShiftX = 2, kTileShiftY = 1;

/// Fills FrameParams, GlyphLayerParams and LayerLook of the target, and makes room for what the layers' passes need.
/// \throws Error(kResourceExhausted) if the tile lists of this view are too long
void fillFrameParameters(gpu::Device& device, ColourTables& colours, Target::Impl& target, const DrawList& list);

}  // namespace radiata::render
