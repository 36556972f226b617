// Where illumination lattices are saved.
#pragma once

#include <filesystem>
#include <string>

namespace radiata::store {

/// Named after the dataset's file and a hash of the key. \param dataset  its file; empty: there is none
/// \param folder  empty: beside the dataset \return empty if there is neither
std::filesystem::path latticePath(const std::filesystem::path& dataset, const std::filesystem::path& folder,
                                  const std::string& key);

}  // namespace radiata::store
