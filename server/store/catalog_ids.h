// Names of datasets: made from file names once, and checked wherever one comes from outside.
#pragma once

#include <filesystem>
#include <string>

namespace radiata::store {

/// File name without its suffix, or nothing if it is no image, environment map, tractogram or mesh.
std::string stemOf(const std::filesystem::path& path);

/// The stem in lower case, of at most 60 characters, with '_' for what an id must not have.
std::string idOf(const std::string& stem);

/// \throws Error(kInvalidArgument) unless it is 1 to 64 characters of a-z, 0-9, '_' and '-'
void checkId(const std::string& id);

/// For messages: short, and nothing in it that would end or garble a line.
std::string printable(const std::string& id);

}  // namespace radiata::store
