// Which segments of each fiblet are shown, one bit each: cuts by regions, inside or outside, and bounds on values per point.
// What Schertzer et al. 2022 do per picture with two depths of a mesh (Sec. 5.1), and per fiblet with a criterion (Sec. 5.2),
// is done once for all cameras here, and right for concave meshes.
#pragma once

#include <cstdint>
#include <vector>

#include "build/region_volume.h"
#include "model/fiblet_set.h"

namespace radiata {

/// Bit i of entry f: segment i of fiblet f is shown.
using SegmentMasks = std::vector<std::uint64_t>;

/// Clears the bits of segments whose middle lies outside of the region (or inside, if `outside` is kept). Segments are short,
/// so a cut is off its surface by half a step at most. Cost: boxes of pages and fiblets, and the segments of fiblets that
/// straddle; all cores.
void keepByRegion(const model::FibletSet& set, const RegionVolume& region, bool outside, SegmentMasks& masks);

/// Clears the bits of segments the mean of whose two points is not within the bounds, or one of which has no value.
void keepByValues(const model::FibletSet& set, const model::PointColumn& column, double low, double high, SegmentMasks& masks);

}  // namespace radiata
