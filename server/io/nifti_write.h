// Writing an image as NIfTI.
#pragma once

#include <filesystem>

#include "io/volume.h"

namespace radiata::io {

/// Writes float32 samples as NIfTI-1, or as NIfTI-2 if an axis is longer than 32767; compressed if the name ends in .gz.
/// The matrix is written as sform (float32 in NIfTI-1) and, as far as a quaternion can hold it, as qform.
/// Equal images give equal bytes. A file that cannot be finished is removed.
/// \throws Error(kInvalidArgument) if data and size disagree, the matrix is unusable, or the name ends in neither .nii nor
///         .nii.gz; (kUnavailable) if writing fails
void writeNifti(const Volume& volume, const std::filesystem::path& path);

}  // namespace radiata::io
