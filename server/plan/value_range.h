// Ends of a colour map that a request leaves open.
#pragma once

#include <algorithm>
#include <cmath>

#include "model/colour_range.h"

namespace radiata::plan {

/// From the smallest to the largest value. A volume of one value, or of a span that no float holds, still gets a range.
inline model::ColourRange valueRange(float low, float high) {
    if (low < high && std::isfinite(high - low)) return {low, high};
    return {low, low + std::max(1.0F, std::abs(low))};
}

}  // namespace radiata::plan
