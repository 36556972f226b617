// The value that splits a volume best in two.
#pragma once

#include "model/scalar_image.h"

namespace radiata {

/// The threshold with the largest variance between the voxels below and above it, over 256 bins from `low` to `high`.
/// Source: Otsu 1979. \param low, high  range of the finite values; equal ones give that value
float splitValue(const model::ScalarImage& image, float low, float high);

}  // namespace radiata
