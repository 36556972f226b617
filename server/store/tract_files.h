// Tractogram files as fiblets: .fiblet files as they are, others encoded on first use and kept in a cache folder.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "model/fiblet_set.h"
#include "model/tractogram.h"

namespace radiata::store {

/// Whether a file's (or .trx folder's) name ends as a tractogram's does, .fiblet included.
bool isTractName(const std::filesystem::path& path);

/// The file as it is, with the columns that lie beside it: BASE_NAME.tsf and BASE_NAME.txt of a file BASE.tck or BASE.trk.
/// Those that do not fit it are left out, and `log` says so.
std::unique_ptr<model::TractogramSource> openTracts(const std::filesystem::path& path,
                                                    const std::function<void(const std::string&)>& log);

/// Encodes with the default bound of 10 um; points whose steps vary, or with which it cannot be held, are set anew. The cache's
/// file is named after the source and a hash of its place, size and time of change, so a source that changed is encoded anew. A
/// cache that cannot be written is no failure: the fibres are served from memory, and `log` says why. \param cache  folder,
/// made if it is not there; empty: nothing is kept \throws as the reader and the encoder
model::FibletSet loadTracts(const std::filesystem::path& path, const std::filesystem::path& cache,
                            const std::function<void(const std::string&)>& log);

}  // namespace radiata::store
