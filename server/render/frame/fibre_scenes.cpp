#include "render/frame/fibre_scenes.h"

#include <algorithm>

namespace radiata::render {

std::shared_ptr<const FibletScene> FibreScenes::scene(gpu::Device& device, const std::shared_ptr<const model::FibletSet>& set) {
    const auto found = std::ranges::find_if(scenes_, [&](const auto& each) { return &each->set() == set.get(); });
    if (found != scenes_.end()) {
        scenes_.splice(scenes_.begin(), scenes_, found);
    } else {
        scenes_.push_front(std::make_shared<const FibletScene>(device, set, budget_bytes_));
        if (scenes_.size() > kScenesKept) scenes_.pop_back();
    }
    return scenes_.front();
}

template <typename Part, typename Make>
std::shared_ptr<const Part> FibreScenes::find(std::list<Kept<Part>>& kept, const FibletScene& scene,
                                              const model::TractogramLayer& layer, Make&& make) {
    const auto found = std::ranges::find_if(
        kept, [&](const Kept<Part>& each) { return each.scene_serial == scene.serial() && each.layer == layer; });
    if (found != kept.end()) {
        kept.splice(kept.begin(), kept, found);
    } else {
        kept.push_front({scene.serial(), layer, make()});
        if (kept.size() > kLooksKept) kept.pop_back();
    }
    return kept.front().part;
}

FibreLook FibreScenes::look(gpu::Device& device, const std::shared_ptr<const FibletScene>& scene,
                            const model::TractogramLayer& layer, FibreSelector& selector) {
    model::TractogramLayer filter, colour;
    filter.shown = layer.shown;
    filter.selected = layer.selected;
    filter.unselected = layer.unselected;
    filter.region_cuts = layer.region_cuts;
    filter.criteria = layer.criteria;
    // What a map does with values is decided when they are shown.
    colour.colour.mode = layer.colour.mode;
    colour.colour.column = layer.colour.column;
    colour.colour.component = layer.colour.component;
    colour.colour.region = layer.colour.region;
    return {find(filters_, *scene, filter,
                 [&] { return std::make_shared<const FibreFilter>(device, scene->set(), layer, selector); }),
            find(colours_, *scene, colour,
                 [&] { return std::make_shared<const FibreColours>(device, scene->set(), layer.colour, selector); })};
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
