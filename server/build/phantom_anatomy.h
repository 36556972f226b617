// A scalar volume of the test brain, somewhat like a T1 image, for isosurfaces around its glyphs.
#pragma once

#include <cstdint>

#include "model/scalar_image.h"

namespace radiata {

/// Mean over 2x2x2 points per voxel of 0 outside, 20 in fluid, 70 in grey and 100 in white matter; the grid covers the head's
/// inside with two voxels of outside around it, so surfaces are closed. The same for the same seed on any number of threads.
/// \param voxel_mm  edge of the cubic voxels, 0.25 to 20
/// \throws Error(kInvalidArgument) for another edge
model::ScalarImage phantomAnatomy(std::uint64_t seed, double voxel_mm);

}  // namespace radiata
