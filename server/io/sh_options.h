// How to understand an SH image whose file does not say.
#pragma once

#include <optional>

#include "math/sh_convention.h"

namespace radiata::io {

/// What is absent follows the file type: .mif, .mih and .nii are read as tournier07 in world axes, as MRtrix3 writes them.
struct ShOptions {
    std::optional<ShConvention> convention;
    std::optional<ShAxes> axes;
    std::optional<bool> full;  ///< for counts that fit both layouts
};

}  // namespace radiata::io
