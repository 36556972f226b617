// Which fibres of a tractogram meet a region: pages first, then fiblets, then the segments of those whose boxes straddle.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "build/region_volume.h"
#include "model/fiblet_set.h"

namespace radiata {

/// What is known of one fibre and one region; flags.
enum FibreRegionFlag : std::uint8_t {
    kMeets = 1,   ///< some of its line is inside
    kLeaves = 2,  ///< some of its line is outside
    kFirstEnd = 4,
    kLastEnd = 8,  ///< the end is inside
};

/// Flags for each fibre, on all cores; 0 for a fibre without points. The line is that of the decoded points.
/// Cost: boxes of all pages, those of the fiblets in pages that straddle, and the segments of fiblets that do.
std::vector<std::uint8_t> fibreRegionFlags(const model::FibletSet& set, const RegionVolume& region);

/// Whether a fibre meets the regions one after another, from one end or the other: region k + 1 not before region k, in steps
/// of whole segments. \param points  of the fibre, world mm
bool meetsInOrder(std::span<const glm::dvec3> points, std::span<const std::unique_ptr<RegionVolume>> regions);

/// Lengths of the decoded lines, mm.
std::vector<float> fibreLengths(const model::FibletSet& set);

}  // namespace radiata
