// An SH image as the volumes of a file: the reverse of reading one.
#pragma once

#include "io/volume.h"
#include "model/sh_image.h"

namespace radiata::io {

/// All voxels of the grid, zero where the image has no glyph; one volume per coefficient, in the convention and axes given.
/// Error: none for descoteaux07, descoteaux07_legacy and tournier07 in world axes; one rounding to float for mrtrix0.2; below
/// 1e-6 of the largest coefficient of a voxel for kVoxel. \throws Error(kResourceExhausted) for more samples than fit
Volume shVolume(const model::ShImage& image, ShConvention convention, ShAxes axes = ShAxes::kWorld);

}  // namespace radiata::io
