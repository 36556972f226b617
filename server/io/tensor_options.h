// How to understand an image of tensors: which volume is which component.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "math/sh_convention.h"

namespace radiata::io {

/// docs/formats/tensors.md. In brackets: the axes of the directions unless TensorOptions says otherwise.
enum class TensorFormat {
    kMrtrix,           ///< xx, yy, zz, xy, xz, yz (world)
    kDipy,             ///< xx, xy, yy, xz, yz, zz: lower triangle by rows (voxel)
    kFsl,              ///< xx, xy, xz, yy, yz, zz: upper triangle by rows (voxel, first axis mirrored on right-handed grids)
    kVoigtStiffness,   ///< 6x6 matrix without factors; 21 volumes (upper triangle by rows) or 36 (world)
    kVoigtCompliance,  ///< the same with factor 2 on each shear pair
    kMandel,           ///< the same with factor sqrt 2 on each shear pair
    kSymmetric,        ///< any order n: (n + 1) (n + 2) / 2 components as math/cartesian_tensor.h orders them (world)
    kEntries,          ///< any order n: all 3^n entries, last index fastest (world)
};

/// "mrtrix", "dipy", "fsl", "voigt-stiffness", "voigt-compliance", "mandel", "symmetric", "entries"
std::string_view name(TensorFormat format);
/// \throws Error(kInvalidArgument) that lists the names
TensorFormat tensorFormatFromName(std::string_view name);

/// What a header says about the tensors behind it: the keys tensor_order, tensor_components and tensor_trace of .mif and .mih.
struct TensorHeader {
    int order = 0;
    TensorFormat components = TensorFormat::kSymmetric;  ///< or kEntries
    std::optional<double> trace;  ///< sum over all voxels of T_iijj..., even orders only; a check of order and components
};

struct TensorOptions {
    std::optional<TensorFormat> format;  ///< none: the header must say
    std::optional<ShAxes> axes;          ///< none: the format's
};

}  // namespace radiata::io
