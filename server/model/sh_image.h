// An image with one function on the sphere per voxel, as the readers deliver it and the device gets it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "math/sh_convention.h"
#include "math/sh_layout.h"

namespace radiata::model {

/// Coefficients are in the internal convention (ShConvention::kDescoteaux07) with directions in world axes, whatever the file
/// had. Only voxels with a glyph are stored: finite coefficients, not all zero.
struct ShImage {
    glm::ivec3 size{0};              ///< voxels along i, j, k
    glm::dmat4 voxel_to_world{1.0};  ///< voxel centres have whole indices; world mm, RAS
    ShLayout layout;
    std::vector<glm::ivec3> voxels;                            ///< indices of the stored voxels, i fastest, then j, then k
    std::vector<float> coefficients;                           ///< voxels.size() * layout.count(), voxel by voxel
    std::uint64_t rejected_voxels = 0;                         ///< left out for a NaN or infinite coefficient
    ShConvention file_convention = ShConvention::kTournier07;  ///< how the file was read
    ShAxes file_axes = ShAxes::kWorld;
    std::string source;  ///< short name for messages

    /// Of images that were read as tensors, whose exact SH coefficients then stand above: order 2 to 12; 0: not a tensor image.
    int tensor_order = 0;
    /// voxels.size() * symmetricCount(tensor_order) components in world axes, voxel by voxel (math/cartesian_tensor.h)
    std::vector<float> tensors;
    std::string tensor_format;  ///< how the file was read: "mrtrix", "voigt-stiffness", ...
};

}  // namespace radiata::model
