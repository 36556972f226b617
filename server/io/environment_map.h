// Pictures of the sky in Radiance's format (.hdr), latitude by longitude.
#pragma once

#include <filesystem>

#include "model/illumination.h"

namespace radiata::io {

/// \throws Error(kNotFound) if there is no such regular file, (kUnsupported) for a picture of more than 16384 pixels a side or
/// a
///         file over 1 GiB, (kCorrupt) with the reader's reason if it is no Radiance picture, Error of checkEnvironmentMap()
model::EnvironmentMap readEnvironmentMap(const std::filesystem::path& path);

/// Pixels along its width and height, from the header alone. \throws as readEnvironmentMap()
glm::ivec2 readEnvironmentMapSize(const std::filesystem::path& path);

/// \throws Error(kInvalidArgument) unless the picture is twice as wide as high (to 1 in 8) and every value finite and at least
/// 0;
///         says the first pixel that is not
void checkEnvironmentMap(const model::EnvironmentMap& map);

}  // namespace radiata::io
