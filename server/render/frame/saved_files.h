// Which saved illumination lattices a picture may be lit from. Known from the request alone, so that they are read before the
// picture is drawn, on another thread.
#pragma once

#include <filesystem>
#include <vector>

#include "io/lattice_file.h"
#include "model/frame.h"
#include "store/store.h"

namespace radiata::render {

struct SavedFile {
    std::filesystem::path file;  ///< there may be none
    io::LatticeHeader header;    ///< what it must say of itself
};

/// Of each layer that the scene's lattices light, datasets without a file left out. Any thread; the layers' volumes and the
/// environment should be resident, else they are read. \throws Error of the store
std::vector<SavedFile> savedFiles(store::Store& store, const model::FrameRequest& request);

}  // namespace radiata::render
