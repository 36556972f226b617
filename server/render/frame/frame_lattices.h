// Illumination lattices that frames share: the last few are kept, and whole ones are saved and taken from where they were.
#pragma once

#include <filesystem>
#include <list>
#include <memory>

#include "render/frame/pass_run.h"
#include "render/light/lattice.h"
#include "store/store.h"

namespace radiata::render {

class FrameLattices {
public:
    /// Gives the layers of a planned frame that have global light their lattices, up to date with it.
    void prepare(const PassRun& run, DrawList& list, store::Store& store);

    /// Saves lattices that were asked for as a whole and have become so.
    void save(const DrawList& list, store::Store& store);

private:
    struct Kept {
        std::shared_ptr<IlluminationLattice> lattice;
        std::filesystem::path taken;  ///< its texels come from this file
    };
    Kept& find(gpu::Device& device, const std::shared_ptr<const store::VolumeDataset>& volume, const model::Illumination& light,
               bool projected, store::Store& store);

    std::list<Kept> kept_;  ///< most recently used first
};

}  // namespace radiata::render
