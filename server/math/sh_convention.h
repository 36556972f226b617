// The four spherical-harmonics conventions that files of this field use, and the map between them.
#pragma once

#include <span>
#include <string_view>

#include "math/sh_layout.h"

namespace radiata {

/// Let Y be complex spherical harmonics with Condon-Shortley phase, orthonormal. Real basis function of (l, m):
///                       m < 0                     m = 0      m > 0
///  kDescoteaux07        sqrt2 Re Y_l^m            Y_l^0      sqrt2 Im Y_l^m     (DIPY legacy=False, Peters 2023)
///  kDescoteaux07Legacy  sqrt2 Re Y_l^|m|          Y_l^0      sqrt2 Im Y_l^m     (DIPY's default, scilpy)
///  kTournier07          sqrt2 Im Y_l^|m|          Y_l^0      sqrt2 Re Y_l^m     (MRtrix3)
///  kMrtrix02            Im Y_l^|m|                Y_l^0      Re Y_l^m           (MRtrix 0.2; not orthonormal)
/// kDescoteaux07 is the one that all code behind the readers uses.
enum class ShConvention { kDescoteaux07, kDescoteaux07Legacy, kTournier07, kMrtrix02 };

/// Axes in which directions are written: the scanner's (world, RAS) or those of the voxel grid.
enum class ShAxes { kWorld, kVoxel };

/// "descoteaux07", "descoteaux07_legacy", "tournier07", "mrtrix0.2"
std::string_view name(ShConvention convention);
/// "world", "voxel"
std::string_view name(ShAxes axes);
/// \throws Error(kInvalidArgument) that lists the names
ShConvention shConventionFromName(std::string_view name);
ShAxes shAxesFromName(std::string_view name);

/// Rewrites the coefficients of one function from one convention to another; the function stays the same.
/// \param coefficients  layout.count() values
void convertSh(std::span<float> coefficients, ShLayout layout, ShConvention from, ShConvention to);
void convertSh(std::span<double> coefficients, ShLayout layout, ShConvention from, ShConvention to);

}  // namespace radiata
