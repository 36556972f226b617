// What the passes read about a frame and its layers, for the camera of the first sample.
#pragma once

#include <optional>

#include "render/frame/colour_tables.h"
#include "render/frame/pass_run.h"

namespace radiata::render {

/// Pixels per tile of the lists, log2.
constexpr int kTileShiftX = 2, kTileShiftY = 1;

/// What the passes read about one set of glyphs, drawn as `glyphs` says: its device addresses, with the structure of
/// `traversal` (none: nobody walks the boxes) for the camera in the target's frame, and room for its tables. `frame` gets the
/// size of the lists, if there are any. \throws Error(kResourceExhausted) if the tile lists of this view are too long
shader::GlyphLayerParams glyphParameters(gpu::Device& device, const Target::Impl& target, LayerBuffers& buffers,
                                         GlyphScene& scene, const plan::GlyphPlan& glyphs,
                                         std::optional<model::Traversal> traversal, shader::FrameParams& frame);

/// Fills FrameParams, GlyphLayerParams and LayerLook of the target, and makes room for what the layers' passes need.
/// \throws Error(kResourceExhausted) if the tile lists of this view are too long
void fillFrameParameters(gpu::Device& device, ColourTables& colours, Target::Impl& target, const DrawList& list);

}  // namespace radiata::render
