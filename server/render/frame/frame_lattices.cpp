#include "render/frame/frame_lattices.h"

#include "base/error.h"
#include "render/frame/illumination_passes.h"

namespace radiata::render {
namespace {

constexpr std::size_t kKept = 4;

/// Texels that an earlier run of the server saved.
void takeSaved(const LatticeRun& run, IlluminationLattice& lattice, const std::string& dataset, store::Store& store) {
    const std::filesystem::path file = store.latticeFile(dataset, lattice.key());
    std::error_code failure;
    if (file.empty() || !std::filesystem::is_regular_file(file, failure)) return;
    try {
        lattice.restore(run, file);
        store.note(file.filename().string() + ": texels of " + dataset + " are taken from it");
    } catch (const Error& error) {
        if (error.code() == Code::kCancelled) throw;
        store.note(std::string(error.what()) + "; texels are computed");
    }
}

}  // namespace

std::shared_ptr<IlluminationLattice> FrameLattices::find(gpu::Device& device,
                                                         const std::shared_ptr<const store::VolumeDataset>& volume,
                                                         const model::Illumination& light, bool projected) {
    for (auto it = kept_.begin(); it != kept_.end(); ++it) {
        if (&(*it)->volume() != volume.get() || (*it)->projected() != projected ||
            !IlluminationLattice::sameTexels((*it)->settings(), light)) {
            continue;
        }
        kept_.splice(kept_.begin(), kept_, it);
        return kept_.front();
    }
    kept_.push_front(std::make_shared<IlluminationLattice>(device, volume, light, projected));
    if (kept_.size() > kKept) kept_.pop_back();
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
        drawn.lattice = find(run.device, drawn.volume, wanted, false);
        if (wanted.project) drawn.rest_lattice = find(run.device, drawn.volume, wanted, true);
        const auto map = wanted.environment ? store.environment(wanted.environment->id) : nullptr;
        const LatticeRun lattice_run = latticeRun(run);
        if (drawn.lattice->update(lattice_run, wanted, map, surface.colour, *surface.isovalue)) {
            takeSaved(lattice_run, *drawn.lattice, surface.dataset_id, store);
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
            if (!file.empty()) said = file.filename().string();
        } catch (const Error& error) {
            said = "not saved: " + std::string(error.what());
        }
        lattice->noteSaved(said);
        store.note("the whole illumination lattice of " + dataset + ": " + said);
    }
}

}  // namespace radiata::render
