#include "session/vulkan_backend.h"

#include <algorithm>
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

/// Ids of all datasets that the request is drawn from; tractograms name those of their regions when they are selected from.
std::vector<std::string> datasetsOf(const model::FrameRequest& request) {
    std::vector<std::string> ids;
    for (const model::Layer& layer : request.scene.layers) {
        ids.push_back(layer.datasetId());
        if (const model::GlyphLayer* glyphs = layer.ifGlyphs()) {
            if (glyphs->uncertainty) ids.push_back(glyphs->uncertainty->dataset_id);
            if (glyphs->colour.mode == model::ColourMode::kScalar) ids.push_back(glyphs->colour.image_id);
        }
        const model::IsosurfaceLayer* surface = layer.ifSurface();
        if (surface && surface->colour_by) ids.push_back(surface->colour_by->image_id);
    }
    const auto& illumination = request.scene.light.illumination;
    if (illumination && illumination->environment) ids.push_back(illumination->environment->id);
    return ids;
}

bool resident(store::Store& store, const model::FrameRequest& request) {
    const std::vector<std::string> ids = datasetsOf(request);
    return std::all_of(ids.begin(), ids.end(), [&](const std::string& id) { return store.resident(id); });
}

void load(store::Store& store, const model::FrameRequest& request) {
    for (const std::string& id : datasetsOf(request)) store.info(id);
    for (const model::Layer& layer : request.scene.layers) {
        if (layer.ifSurface()) store.volume(layer.datasetId());
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
