// Tractogram files as fiblets: .fiblet files as they are, others encoded on first use and kept in a cache folder.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "io/vtk_lines.h"
#include "model/fiblet_set.h"
#include "model/tractogram.h"

namespace radiata::store {

/// Whether a file's (or .trx folder's) name ends as a tractogram's does, .fiblet included.
bool isTractName(const std::filesystem::path& path);

struct TractReading {
    std::filesystem::path cache;  ///< folder for what is encoded, made if it is not there; empty: nothing is kept
    io::VtkSpace vtk_space = io::VtkSpace::kAuto;  ///< of .vtk and .vtp files
};

/// The file as it is, with the columns that lie beside it: BASE_NAME.tsf and BASE_NAME.txt of a file BASE.tck or BASE.trk.
/// Those that do not fit it are left out, and `log` says so.
std::unique_ptr<model::TractogramSource> openTracts(const std::filesystem::path& path, const TractReading& reading,
                                                    const std::function<void(const std::string&)>& log);

/// Encodes with the default bound of 10 um; points whose steps vary, or with which it cannot be held, are set anew; a few
/// fibres so far out that it cannot be held for the others are left out. `log` is told so, and what was assumed about the file
/// (the set's remarks). The cache's file is named after the source and a hash of its place, size and time of change, so a
/// source that changed is encoded anew. A cache that cannot be written is no failure: the fibres are served from memory, and
/// `log` says why. \throws as the reader and the encoder
model::FibletSet loadTracts(const std::filesystem::path& path, const TractReading& reading,
                            const std::function<void(const std::string&)>& log);

}  // namespace radiata::store
