#include "session/vulkan_backend.h"

#include <map>
#include <memory>

#include "build/fibre_selection.h"
#include "io/tractogram.h"
#include "model/selection_text.h"
#include "model/tractogram_subset.h"

namespace radiata::session {
namespace {

model::SelectedFibres select(store::Store& store, const std::string& id, const std::string& selection) {
    const model::Selection parsed = model::parseSelection(selection);
    const FibreBits bits = store.selector(id)->select(parsed);
    return {bits.size(), bits.fibres()};
}

/// Calls `visit` for each dataset that the layer is drawn from, with what it is needed as.
template <typename Visit>
void forEachDataset(const model::Layer& layer, Visit&& visit) {
    visit(layer.datasetId(), &layer);
    if (const model::GlyphLayer* glyphs = layer.ifGlyphs()) {
        if (glyphs->uncertainty) visit(glyphs->uncertainty->dataset_id, nullptr);
        if (glyphs->colour.mode == model::ColourMode::kScalar) visit(glyphs->colour.image_id, nullptr);
    }
}

bool resident(store::Store& store, const model::FrameRequest& request) {
    bool all = true;
    for (const model::Layer& layer : request.scene.layers) {
        forEachDataset(layer, [&](const std::string& id, const model::Layer*) { all = all && store.resident(id); });
    }
    return all;
}

void load(store::Store& store, const model::FrameRequest& request) {
    for (const model::Layer& layer : request.scene.layers) {
        forEachDataset(layer, [&](const std::string& id, const model::Layer* of) {
            if (of && of->ifSurface()) {
                store.volume(id);
            } else {
                store.info(id);
            }
        });
    }
}

}  // namespace

Backend vulkanBackend(render::Renderer& renderer, store::Store& store) {
    // Only the render thread touches the targets.
    const auto targets = std::make_shared<std::map<std::uint64_t, render::Target>>();
    Backend backend;
    backend.render = [&renderer, targets](std::uint64_t view, const model::FrameRequest& request, int first_sample, int count,
                                          const model::Outputs& outputs, const std::atomic<bool>* cancel) {
        return renderer.render((*targets)[view], request, first_sample, count, outputs, cancel);
    };
    backend.release = [targets](std::uint64_t view) { targets->erase(view); };
    backend.fit_camera = [&renderer](const std::string& id, const model::VoxelSelection& selection,
                                     model::Convention convention,
                                     double aspect) { return renderer.fitCamera(id, selection, convention, aspect); };
    backend.pick = [&renderer](const model::FrameRequest& request, int x, int y, int radius_px) {
        return renderer.pick(request, x, y, radius_px);
    };
    backend.pick_fibres = [&renderer](const model::FrameRequest& request, const std::vector<glm::dvec2>& outline,
                                      bool through) { return renderer.pickFibres(request, outline, through); };
    backend.list = [&store] { return store.list(); };
    backend.info = [&store](const std::string& id) { return store.info(id); };
    backend.select = [&store](const std::string& id, const std::string& selection) { return select(store, id, selection); };
    backend.write_fibres = [&store](const std::string& id, const std::string& selection, const std::filesystem::path& file) {
        const auto subset = model::subsetOf(store.tracts(id), select(store, id, selection).fibres);
        return io::writeTractogram(*subset, file);
    };
    backend.resident = [&store](const model::FrameRequest& request) { return resident(store, request); };
    backend.load = [&store](const model::FrameRequest& request) { load(store, request); };
    backend.device = renderer.deviceName();
    backend.traversals = renderer.traversals();
    return backend;
}

}  // namespace radiata::session
