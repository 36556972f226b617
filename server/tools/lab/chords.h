// Random chords through trilinear cells, and their first roots in double: what the cubic's solver is measured on.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gpu/device.h"

namespace radiata::lab {

struct ChordErrors {
    std::uint64_t hits = 0, missed = 0, invented = 0;
    std::uint64_t even = 0;     ///< hits between ends of one sign
    std::vector<double> cells;  ///< error of each hit, in cells
    double ns_per_chord = 0;    ///< device time
};

/// A third of the cells is random, a third nearly planar, a third like computed tomography, whole numbers around 1000.
/// \param count  chords, in parts of a quarter of a million
ChordErrors measureChords(gpu::Device& device, std::uint64_t count);

}  // namespace radiata::lab
