// What the self-tests share: one layer drawn by a way that is to be tested, and where its pixels are.
#pragma once

#include <functional>

#include "model/frame.h"
#include "plan/plan.h"
#include "render/frame/drawer.h"

namespace radiata::render {

struct KnownPicture {
    model::FramePixels pixels;  ///< depth and id
    double depth_offset_mm = 0;
};

/// One sample of a scene of one layer. \param facts  of the layer, as this camera sees it
/// \throws Error if the device cannot draw it
KnownPicture drawKnownPicture(gpu::Device& device, Drawer& drawer, const model::FrameRequest& request, DrawnLayer layer,
                              const std::function<plan::LayerFacts(const plan::RebasedCamera&)>& facts,
                              const plan::Abilities& abilities);

}  // namespace radiata::render
