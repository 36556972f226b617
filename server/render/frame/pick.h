// One pixel of a picture, and for fibres those around it, drawn alone: a small picture with the rays of the large one.
#pragma once

#include <optional>
#include <vector>

#include "model/outline.h"
#include "model/pick.h"
#include "render/frame/drawer.h"
#include "render/frame/pick_hits.h"

namespace radiata::render {

/// The request with what a pick needs and no more: one sample by the march, no light to speak of, a traversal that does not
/// depend on the picture's size. \throws Error(kInvalidArgument) for a pixel outside, Error(kUnsupported) if there is no such
/// traversal
model::FrameRequest pickRequest(const model::FrameRequest& request, int x, int y, int radius_px,
                                const plan::Abilities& abilities);

/// Makes transparent isosurfaces of a request opaque. \return whether there were any
bool makeSurfacesOpaque(model::FrameRequest& request);

/// Draws pixel (x, y) of the list's picture and says what its ray hits. \param list  of the whole picture, changed for the
/// pixel \param found_glyph  may be empty
std::optional<model::Picked> pickPixel(gpu::Device& device, Drawer& drawer, Target::Impl& target, DrawList& list, int x, int y,
                                       int radius_px, const FoundGlyph& found_glyph = {});

/// The fibres within the pixels of an outline, for each layer of fibres. \param list  of the whole picture, changed for the
/// outline's window
std::vector<model::PickedFibres> pickOutline(gpu::Device& device, Drawer& drawer, Target::Impl& target, DrawList& list,
                                             const model::OutlinePixels& pixels, bool through);

}  // namespace radiata::render
