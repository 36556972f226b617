#include "render/frame/fibre_scenes.h"

#include <algorithm>
#include <utility>

#include "store/store.h"

namespace radiata::render {
namespace {

/// What of a layer changes its filter.
model::TractogramLayer filterOf(const model::TractogramLayer& layer) {
    model::TractogramLayer filter;
    filter.shown = layer.shown;
    filter.selected = layer.selected;
    filter.unselected = layer.unselected;
    filter.region_cuts = layer.region_cuts;
    filter.criteria = layer.criteria;
    return filter;
}

/// What of a layer changes its colours. What a map does with values is decided when they are shown.
model::TractogramLayer colourOf(const model::TractogramLayer& layer) {
    model::TractogramLayer colour;
    colour.colour.mode = layer.colour.mode;
    colour.colour.column = layer.colour.column;
    colour.colour.component = layer.colour.component;
    colour.colour.region = layer.colour.region;
    return colour;
}

}  // namespace

FibreScenes::Scenes::const_iterator FibreScenes::find(const Scenes& scenes, const model::FibletSet& set) {
    return std::ranges::find_if(scenes, [&](const auto& each) { return &each->set() == &set; });
}

template <typename Part>
typename std::list<FibreScenes::Kept<Part>>::const_iterator FibreScenes::find(const std::list<Kept<Part>>& kept,
                                                                              const FibletScene& scene,
                                                                              const model::TractogramLayer& layer) {
    return std::ranges::find_if(
        kept, [&](const Kept<Part>& each) { return each.scene_serial == scene.serial() && each.layer == layer; });
}

std::shared_ptr<const FibletScene> FibreScenes::scene(gpu::Device& device, const std::shared_ptr<const model::FibletSet>& set) {
    std::shared_ptr<const FibletScene> made;
    for (;;) {
        std::unique_lock lock(mutex_);
        if (const auto found = find(scenes_, *set); found != scenes_.end()) {
            scenes_.splice(scenes_.begin(), scenes_, found);
        } else if (made) {
            scenes_.push_front(std::move(made));
            if (scenes_.size() > kScenesKept) scenes_.pop_back();
        } else {
            lock.unlock();
            made = std::make_shared<const FibletScene>(device, set, budget_bytes_);
            continue;
        }
        return scenes_.front();
    }
}

template <typename Part, typename Make>
std::shared_ptr<const Part> FibreScenes::keep(std::list<Kept<Part>>& kept, const FibletScene& scene,
                                              const model::TractogramLayer& layer, Make&& make) {
    std::shared_ptr<const Part> made;
    for (;;) {
        std::unique_lock lock(mutex_);
        if (const auto found = find(kept, scene, layer); found != kept.end()) {
            kept.splice(kept.begin(), kept, found);
        } else if (made) {
            kept.push_front({scene.serial(), layer, std::move(made)});
            if (kept.size() > kLooksKept) kept.pop_back();
        } else {
            lock.unlock();
            made = make();
            continue;
        }
        return kept.front().part;
    }
}

FibreLook FibreScenes::look(gpu::Device& device, const std::shared_ptr<const FibletScene>& scene,
                            const model::TractogramLayer& layer, FibreSelector& selector) {
    return {keep(filters_, *scene, filterOf(layer),
                 [&] { return std::make_shared<const FibreFilter>(device, scene->set(), layer, selector); }),
            keep(colours_, *scene, colourOf(layer),
                 [&] { return std::make_shared<const FibreColours>(device, scene->set(), layer.colour, selector); })};
}

bool FibreScenes::hold(store::Store& store, const model::FrameRequest& request) const {
    return std::ranges::all_of(request.scene.layers, [&](const model::Layer& each) {
        const model::TractogramLayer* layer = each.ifTracts();
        if (layer == nullptr) return true;
        const std::shared_ptr<const model::FibletSet> set = store.fiblets(layer->dataset_id);
        std::lock_guard lock(mutex_);
        const auto scene = find(scenes_, *set);
        return scene != scenes_.end() && find(filters_, **scene, filterOf(*layer)) != filters_.end() &&
               find(colours_, **scene, colourOf(*layer)) != colours_.end();
    });
}

void FibreScenes::bring(gpu::Device& device, store::Store& store, const model::FrameRequest& request) {
    for (const model::Layer& each : request.scene.layers) {
        if (const model::TractogramLayer* layer = each.ifTracts()) {
            look(device, scene(device, store.fiblets(layer->dataset_id)), *layer, *store.selector(layer->dataset_id));
        }
    }
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
