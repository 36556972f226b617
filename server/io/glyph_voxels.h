// What the readers of images with one function per voxel share: the grid, and which voxels get a glyph.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "io/stored_image.h"
#include "model/sh_image.h"

namespace radiata::io {

/// Copies size, matrix and name. \throws Error(kResourceExhausted) for an axis that an int cannot count
void setGrid(const StoredImage& stored, const std::string& file, model::ShImage& image);

/// Fills voxels and rejected_voxels: a glyph stands where all samples are finite and not all are zero.
/// \param data  volume by volume, as readSamples() gives it
/// \return for each entry of image.voxels the index of its sample in each volume
std::vector<std::size_t> setVoxels(const std::vector<float>& data, std::size_t voxel_count, model::ShImage& image);

}  // namespace radiata::io
