// NIfTI-1 and NIfTI-2 headers in one file with their data (.nii, .nii.gz).
#pragma once

#include <filesystem>

#include "io/stored_image.h"

namespace radiata::io {

/// The NIfTI reference library recognises version and byte order and knows sizes and the quaternion; it is given a header of
/// full length in memory and never the file, because its own reader trusts what a header says.
/// The matrix is the sform if its code is above 0, else the qform, else the voxel sizes alone (NIfTI-1 method 1).
/// Lengths are taken as mm whatever xyzt_units says, as MRtrix3 and nibabel do.
/// scl_slope 0 or NaN means unscaled; pixdim beyond the third axis is not looked at (MRtrix3 writes NaN there).
/// \throws Error(kCorrupt, kUnsupported, kResourceExhausted) naming field, value and what would be right
StoredImage readNiftiHeader(const std::filesystem::path& path);

}  // namespace radiata::io
