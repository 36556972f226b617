#include "render/frame/known_picture.h"

#include <utility>

#include "render/frame/outputs.h"

namespace radiata::render {

KnownPicture drawKnownPicture(gpu::Device& device, Drawer& drawer, const model::FrameRequest& request, DrawnLayer layer,
                              const std::function<plan::LayerFacts(const plan::RebasedCamera&)>& facts,
                              const plan::Abilities& abilities) {
    DrawList list;
    list.camera = plan::rebaseCamera(request.camera, layer.bounds, request.height);
    const plan::FramePlan plan = plan::planFrame(request, {facts(list.camera)}, abilities);
    list.plan = &plan;
    list.layers.push_back(std::move(layer));
    Target target;
    target.impl_->prepare(device, request.width, request.height, 1);
    drawer.drawSample(*target.impl_, list, 0, nullptr);
    model::Outputs wanted;
    wanted.depth = wanted.id = true;
    KnownPicture picture;
    readOutputs(device, drawer, *target.impl_, list, wanted, picture.pixels);
    drawer.takeTimings();
    picture.depth_offset_mm = list.camera.depth_offset_mm;
    return picture;
}

}  // namespace radiata::render
