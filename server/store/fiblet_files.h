// Tractograms from files, as fiblets: encoded on first use, kept in a cache folder from then on.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "build/fiblet_encode.h"
#include "model/fiblet_set.h"

namespace radiata::store {

/// Whether a name ends as a tractogram's does, .fiblet included.
bool isTractName(const std::filesystem::path& path);

/// Where the fiblets of a file are kept: the name holds a checksum of its path, size, time of change and of the options.
std::filesystem::path cachedFiblets(const std::filesystem::path& path, const std::filesystem::path& cache_folder,
                                    const FibletOptions& options);

/// Reads a .fiblet file, or any other tractogram by way of the cache. A cached file that is damaged is made anew; if the cache
/// cannot be written, because the disk is full or the folder read-only, the set serves from memory alone. \param cache_folder
/// made if it is not there; empty: nothing is kept \param log           gets a sentence about what was done, may be empty
/// \throws as the readers and encodeFiblets()
model::FibletSet loadTractogram(const std::filesystem::path& path, const std::filesystem::path& cache_folder,
                                const FibletOptions& options, const std::function<void(const std::string&)>& log = {});

}  // namespace radiata::store
