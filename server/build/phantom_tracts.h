// Streamlines along the bundles of the test brain, as many as wanted, of a constant step; made while they are read, so that
// their number is not bounded by memory.
#pragma once

#include <cstdint>
#include <memory>

#include "build/phantom.h"
#include "model/tractogram.h"

namespace radiata {

struct PhantomTractOptions {
    std::uint64_t fibres = 20'000;  ///< up to 2^32 - 1
    double step_mm = 0.5;           ///< 0.01 to 10; each fibre's last segment may be shorter
};

/// Fibres of all bundles, mixed; a bundle has them in proportion to the cross-sections of its strands. Each runs at a place of
/// its own within its strand, from about one end to about the other. Columns: "bundle" per fibre (the bundle's id), "along" per
/// vertex (0 to 1 from the first point to the last). Groups: the bundles by name. The same for the same seed and options.
/// \param phantom  outlives the source  \throws Error(kInvalidArgument) naming an option out of range
std::unique_ptr<model::TractogramSource> phantomTracts(const Phantom& phantom, const PhantomTractOptions& options);

}  // namespace radiata
