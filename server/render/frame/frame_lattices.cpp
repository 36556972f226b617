#include "render/frame/frame_lattices.h"

#include <utility>

#include "base/error.h"
#include "io/lattice_file.h"
#include "render/frame/illumination_passes.h"
#include "store/saved_lattices.h"

namespace radiata::render {
namespace {

constexpr std::size_t kKept = 4;

/// Texels that an earlier run of the server saved, mostly read already (session/vulkan_backend.cpp). \return where from, if so
std::filesystem::path takeSaved(const LatticeRun& run, IlluminationLattice& lattice, const std::string& dataset,
                                store::Store& store) {
    const io::LatticeHeader header = lattice.header();
    const std::filesystem::path file = store.latticeFile(dataset, header.key);
    try {
        const auto saved = store.savedLattices().take(file, header);
        if (!saved) return {};
        lattice.restore(run, *saved);
        store.note(saved->name + ": texels of " + dataset + " are taken from it");
    } catch (const Error& error) {
        if (error.code() == Code::kCancelled) {
            store.savedLattices().forget(file);
            throw;
        }
        store.note(std::string(error.what()) + "; texels are computed");
    }
    return file;
}

}  // namespace

FrameLattices::Kept& FrameLattices::find(gpu::Device& device, const std::shared_ptr<const store::VolumeDataset>& volume,
                                         const model::Illumination& light, bool projected, store::Store& store) {
    for (auto it = kept_.begin(); it != kept_.end(); ++it) {
        if (&it->lattice->volume() != volume.get() || it->lattice->projected() != projected ||
            !IlluminationLattice::sameTexels(it->lattice->settings(), light)) {
            continue;
        }
        kept_.splice(kept_.begin(), kept_, it);
        return kept_.front();
    }
    kept_.push_front({std::make_shared<IlluminationLattice>(device, volume, light, projected), {}});
    if (kept_.size() > kKept) {
        store.savedLattices().forget(kept_.back().taken);
        kept_.pop_back();
    }
    return kept_.front();
}

void FrameLattices::prepare(const PassRun& run, DrawList& list, store::Store& store) {
    for (const plan::PassPlan& pass : list.plan->passes) {
        if (pass.kind != plan::PassKind::kIllumination) continue;
        const auto layer = static_cast<std::size_t>(pass.layer);
        const model::Scene& scene = list.plan->resolved.scene;
        const model::Illumination& wanted = *scene.light.illumination;
        const model::IsosurfaceLayer& surface = scene.layers[layer].surface();
        DrawnLayer& drawn = list.layers[layer];
        if (wanted.project) drawn.rest_lattice = find(run.device, drawn.volume, wanted, true, store).lattice;
        Kept& kept = find(run.device, drawn.volume, wanted, false, store);
        drawn.lattice = kept.lattice;
        const auto map = wanted.environment ? store.environment(wanted.environment->id) : nullptr;
        const LatticeRun lattice_run = latticeRun(run);
        if (drawn.lattice->update(lattice_run, wanted, map, surface.colour, *surface.isovalue)) {
            if (!kept.taken.empty()) store.savedLattices().forget(std::exchange(kept.taken, {}));
            kept.taken = takeSaved(lattice_run, *drawn.lattice, surface.dataset_id, store);
        }
        if (drawn.rest_lattice) drawn.rest_lattice->update(lattice_run, wanted, map, surface.colour, *surface.isovalue);
    }
}

void FrameLattices::save(const DrawList& list, store::Store& store) {
    for (std::size_t i = 0; i < list.layers.size(); ++i) {
        IlluminationLattice* lattice = list.layers[i].lattice.get();
        if (lattice == nullptr || !lattice->settings().full || !lattice->whole() || !lattice->saved().empty() ||
            lattice->info().texels_read > 0) {
            continue;
        }
        const std::string& dataset = list.plan->resolved.scene.layers[i].surface().dataset_id;
        const std::filesystem::path file = store.latticeFile(dataset, lattice->key());
        std::string said = "not saved: the dataset is no file";
        try {
            if (!file.empty()) lattice->save(file);
            store.savedLattices().forget(file);
            if (!file.empty()) said = file.filename().string();
        } catch (const Error& error) {
            said = "not saved: " + std::string(error.what());
        }
        lattice->noteSaved(said);
        store.note("the whole illumination lattice of " + dataset + ": " + said);
    }
}

}  // namespace radiata::render
