// Images of Cartesian tensors: a file's volumes become symmetric components and, exactly, spherical-harmonics coefficients.
// The formats and what is kept of each: docs/formats/tensors.md.
#pragma once

#include <filesystem>

#include "io/tensor_options.h"
#include "model/sh_image.h"

namespace radiata::io {

/// Reads tensors of order 2 to 12. Each is symmetrised (its glyph depends on nothing else), turned to world axes and kept
/// twice: as components and as SH bands to its order, both converted in double and rounded once to float. Directions in voxel
/// axes are turned by the orthogonal polar factor of the grid's matrix, as readShImage() does; format fsl first mirrors the
/// first axis of right-handed grids, which is FSL's rule. \throws as readVolume(); Error(kInvalidArgument) if neither options
/// nor header name the components or if they contradict
///         each other, (kCorrupt) for a number of volumes that the format does not have or a trace other than the header's,
///         (kUnsupported) for orders above 12
model::ShImage readTensorImage(const std::filesystem::path& path, const TensorOptions& options = {});

/// Everything that the header tells: all but voxels and values. \throws as readTensorImage()
model::ShImage readTensorHeader(const std::filesystem::path& path, const TensorOptions& options = {});

/// Whether a header says that its volumes are tensors (tensor_order in .mif and .mih files).
/// \throws as readStoredImage()
bool namesTensors(const std::filesystem::path& path);

}  // namespace radiata::io
