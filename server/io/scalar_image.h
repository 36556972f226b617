// Scalar volumes: images with one volume.
#pragma once

#include <filesystem>

#include "model/scalar_image.h"

namespace radiata::io {

/// \throws as readVolume(); Error(kCorrupt) if the file has more than one volume
model::ScalarImage readScalarImage(const std::filesystem::path& path);

}  // namespace radiata::io
