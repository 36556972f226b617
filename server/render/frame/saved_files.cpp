#include "render/frame/saved_files.h"

#include <utility>

#include "plan/plan_isosurface.h"
#include "render/light/lattice_key.h"

namespace radiata::render {

std::vector<SavedFile> savedFiles(store::Store& store, const model::FrameRequest& request) {
    std::vector<SavedFile> files;
    const auto& light = request.scene.light.illumination;
    if (!light || light->method != model::IlluminationMethod::kLattice) return files;
    for (const model::Layer& layer : request.scene.layers) {
        const model::IsosurfaceLayer* surface = layer.ifSurface();
        if (surface == nullptr || plan::isVeil(layer) || surface->shading != model::SurfaceShading::kScene) continue;
        const auto map = light->environment ? store.environment(light->environment->id) : nullptr;
        io::LatticeHeader header = latticeHeader(*store.volume(surface->dataset_id), *light, map.get(), surface->colour);
        std::filesystem::path file = store.latticeFile(surface->dataset_id, header.key);
        if (!file.empty()) files.push_back({std::move(file), std::move(header)});
    }
    return files;
}

}  // namespace radiata::render
