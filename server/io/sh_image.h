// Spherical-harmonics images: a file's volumes become coefficients in the internal convention and world axes.
#pragma once

#include <filesystem>
#include <string>

#include "io/sh_options.h"
#include "model/sh_image.h"

namespace radiata::io {

/// Reads an SH image. The number of volumes gives the bands: even 1, 6, 15, 28, 45, 66, 91, 120, 153; full 1, 4, 9, ... 289.
/// What `options` leaves open is read as MRtrix3 writes it: tournier07, directions in world axes; describe() prints it.
///
/// Axes kVoxel: direction (1, 0, 0) of the file points along increasing first index. The function is turned to world axes by
/// the orthogonal polar factor of the 3x3 part of voxel_to_world, which mirrors if the grid is left-handed (a flipped first
/// axis) and ignores voxel sizes and shear. This is DIPY's rule. FSL's differs for right-handed grids (positive determinant):
/// there its gradient directions have their first component negated, so SH fitted to unchanged FSL gradients on such a grid are
/// mirrored and must be fitted to directions in the grid's own axes first.
///
/// Cost: about 0.4 s for 200,000 voxels of 45 volumes, compressed. Error: none for descoteaux07, descoteaux07_legacy and
/// tournier07 in world axes (signs and order only); one rounding to float for mrtrix0.2; below 1e-6 of the largest coefficient
/// of a voxel for kVoxel.
/// \throws as readVolume(); Error(kCorrupt) for a number of volumes that no layout has, listing those that would do
model::ShImage readShImage(const std::filesystem::path& path, const ShOptions& options = {});

/// What the header of an SH image says: everything but voxels and coefficients. \throws as readShImage() for what a header can
/// tell
model::ShImage readShHeader(const std::filesystem::path& path, const ShOptions& options = {});

/// One line for logs: what was read and what was assumed (layout, convention, axes, voxels).
std::string describe(const model::ShImage& image);

}  // namespace radiata::io
