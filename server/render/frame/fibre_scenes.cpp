#include "render/frame/fibre_scenes.h"

#include <algorithm>

namespace radiata::render {

std::shared_ptr<const FibletScene> FibreScenes::scene(gpu::Device& device, const std::shared_ptr<const model::FibletSet>& set) {
    const auto found = std::ranges::find_if(scenes_, [&](const auto& each) { return &each->set() == set.get(); });
    if (found != scenes_.end()) {
        scenes_.splice(scenes_.begin(), scenes_, found);
    } else {
        scenes_.push_front(std::make_shared<const FibletScene>(device, set));
        if (scenes_.size() > kScenesKept) scenes_.pop_back();
    }
    return scenes_.front();
}

std::shared_ptr<const FibreLook> FibreScenes::look(gpu::Device& device, const std::shared_ptr<const FibletScene>& scene,
                                                   const model::TractogramLayer& layer) {
    model::TractogramLayer key;
    key.shown = layer.shown;
    key.selected = layer.selected;
    key.unselected = layer.unselected;
    key.colour.mode = layer.colour.mode;
    key.colour.column = layer.colour.column;
    const auto found = std::ranges::find_if(
        looks_, [&](const KeptLook& each) { return each.scene_serial == scene->serial() && each.layer == key; });
    if (found != looks_.end()) {
        looks_.splice(looks_.begin(), looks_, found);
    } else {
        looks_.push_front({scene->serial(), key, std::make_shared<const FibreLook>(device, scene->set(), layer)});
        if (looks_.size() > kLooksKept) looks_.pop_back();
    }
    return looks_.front().look;
}

std::shared_ptr<const FibreVertices> FibreScenes::vertices(gpu::Device& device,
                                                           const std::shared_ptr<const FibletScene>& scene) {
    if (vertices_serial_ != scene->serial()) {
        vertices_.reset();
        vertices_ = std::make_shared<const FibreVertices>(device, scene->set());
        vertices_serial_ = scene->serial();
    }
    return vertices_;
}

}  // namespace radiata::render
