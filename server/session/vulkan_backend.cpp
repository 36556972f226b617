#include "session/vulkan_backend.h"

#include <algorithm>
#include <map>
#include <memory>

#include "base/error.h"
#include "build/fibre_selection.h"
#include "io/tractogram.h"
#include "model/selection_text.h"
#include "model/tractogram_subset.h"
#include "render/frame/saved_files.h"
#include "store/saved_lattices.h"

namespace radiata::session {
namespace {

model::SelectedFibres select(store::Store& store, const std::string& id, const std::string& selection) {
    const model::Selection parsed = model::parseSelection(selection);
    const FibreBits bits = store.selector(id)->select(parsed);
    return {bits.size(), bits.fibres()};
}

/// Masks and meshes of the regions that a selection names.
void addRegions(const model::Selection& selection, std::vector<std::string>& ids) {
    for (const model::FibreRegion& region : selection.regions) {
        if (!region.dataset.empty()) ids.push_back(region.dataset);
    }
    for (const model::Selection& child : selection.children) addRegions(child, ids);
}

/// What cannot be read as a selection or region names nothing; whoever checks the request says what is wrong with it.
void addRegions(const model::TractogramLayer& fibres, std::vector<std::string>& ids) {
    std::vector<std::string> texts{fibres.shown.selection};
    if (fibres.selected) texts.push_back(fibres.selected->selection);
    // A region alone is a selection too.
    for (const model::FibreRegionCut& cut : fibres.region_cuts) texts.push_back(cut.region);
    if (fibres.colour.mode == model::FibreColourMode::kDistance) texts.push_back(fibres.colour.region);
    for (const std::string& text : texts) {
        try {
            if (!text.empty()) addRegions(model::parseSelection(text), ids);
        } catch (const Error&) {
        }
    }
}

/// Ids of all datasets that the request is drawn from.
std::vector<std::string> datasetsOf(const model::FrameRequest& request) {
    std::vector<std::string> ids;
    for (const model::Layer& layer : request.scene.layers) {
        ids.push_back(layer.datasetId());
        if (const model::GlyphLayer* glyphs = layer.ifGlyphs()) {
            if (glyphs->uncertainty) ids.push_back(glyphs->uncertainty->dataset_id);
            if (glyphs->colour.mode == model::ColourMode::kScalar) ids.push_back(glyphs->colour.image_id);
        }
        if (const model::TractogramLayer* fibres = layer.ifTracts()) addRegions(*fibres, ids);
        const model::IsosurfaceLayer* surface = layer.ifSurface();
        if (surface && surface->colour_by) ids.push_back(surface->colour_by->image_id);
    }
    const auto& illumination = request.scene.light.illumination;
    if (illumination && illumination->environment) ids.push_back(illumination->environment->id);
    return ids;
}

bool drawsTriangles(const model::FrameRequest& request, const model::Layer& layer) {
    return layer.opacity >= 1 && request.quality.isosurface.method == model::SurfaceMethod::kMarchingCubes;
}

bool resident(store::Store& store, const model::FrameRequest& request) {
    const std::vector<std::string> ids = datasetsOf(request);
    if (!std::ranges::all_of(ids, [&](const std::string& id) { return store.resident(id); })) return false;
    const bool volumes = std::ranges::all_of(request.scene.layers, [&](const model::Layer& layer) {
        const model::IsosurfaceLayer* surface = layer.ifSurface();
        if (surface == nullptr) return true;
        return store.volumeResident(surface->dataset_id) &&
               (!surface->colour_by || store.volumeResident(surface->colour_by->image_id)) &&
               (!drawsTriangles(request, layer) || store.trianglesResident(surface->dataset_id, surface->isovalue));
    });
    // A request that cannot be drawn names no file: whoever draws it says what is wrong with it.
    try {
        return volumes && std::ranges::all_of(render::savedFiles(store, request), [&](const render::SavedFile& saved) {
                   return store.savedLattices().resident(saved.file);
               });
    } catch (const Error&) {
        return true;
    }
}

void load(store::Store& store, const model::FrameRequest& request) {
    for (const std::string& id : datasetsOf(request)) store.info(id);
    for (const model::Layer& layer : request.scene.layers) {
        const model::IsosurfaceLayer* surface = layer.ifSurface();
        if (surface == nullptr) continue;
        store.volume(surface->dataset_id);
        if (surface->colour_by) store.volume(surface->colour_by->image_id);
        if (drawsTriangles(request, layer)) store.triangles(surface->dataset_id, surface->isovalue);
    }
    for (const render::SavedFile& saved : render::savedFiles(store, request)) {
        store.savedLattices().read(saved.file, saved.header);
    }
}

/// Of the views; only the render thread touches them. One view's memory waits for the next one's.
class Targets {
public:
    render::Target& of(std::uint64_t view) {
        const auto [entry, is_new] = targets_.try_emplace(view);
        if (is_new) std::swap(entry->second, spare_);
        return entry->second;
    }

    void release(std::uint64_t view) {
        const auto entry = targets_.find(view);
        if (entry == targets_.end()) return;
        spare_ = std::move(entry->second);
        spare_.forget();
        targets_.erase(entry);
    }

private:
    std::map<std::uint64_t, render::Target> targets_;
    render::Target spare_;
};

}  // namespace

Backend vulkanBackend(render::Renderer& renderer, store::Store& store) {
    const auto targets = std::make_shared<Targets>();
    Backend backend;
    backend.render = [&renderer, targets](std::uint64_t view, const model::FrameRequest& request, int first_sample, int count,
                                          const model::Outputs& outputs, const std::atomic<bool>* cancel) {
        return renderer.render(targets->of(view), request, first_sample, count, outputs, cancel);
    };
    backend.release = [targets](std::uint64_t view) { targets->release(view); };
    backend.fit_camera = [&renderer](const std::string& id, const model::VoxelSelection& selection,
                                     model::Convention convention,
                                     double aspect) { return renderer.fitCamera(id, selection, convention, aspect); };
    backend.pick = [&renderer](const model::FrameRequest& request, int x, int y, int radius_px, bool all_hits) {
        return renderer.pick(request, x, y, radius_px, all_hits);
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
