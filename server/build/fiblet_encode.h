// From streamlines to fiblets.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include <glm/glm.hpp>

#include "build/fiblet_measure.h"
#include "model/fiblet_set.h"
#include "model/tractogram.h"

namespace radiata {

struct FibletOptions {
    double bound_um = 10;           ///< largest distance between a point and its decoded one, above 0
    double walk_bound_um = 100;     ///< if steps vary: largest distance between a point and the line that is encoded
    double step_mm = 0;             ///< of all segments but each fibre's last; 0: to be chosen
    std::uint32_t beam = 8;         ///< beginnings kept while searching, up to 64; 0: none, each code the nearest to its aim
    std::uint32_t least_width = 4;  ///< bits per point at least: 4, 6, 8 or 16
};

/// Encodes a tractogram. Fibres whose segments all have one length, but for each fibre's last, which may be shorter, keep their
/// points; others are walked (build/fiblet_walk.h). Fibres without points stay without fiblets and keep their numbers. Equal
/// input gives equal bytes, whatever the number of threads. \param open  gives the tractogram from its beginning; called two or
/// three times \throws Error(kInvalidArgument) naming the fibre if a bound cannot be held or a fibre has more than 63 * 4096
/// segments; and as the
///         source
model::FibletSet encodeFiblets(const OpenTractogram& open, const FibletOptions& options, const FibletProgress& progress = {});

/// The same of a tractogram in memory.
model::FibletSet encodeFiblets(const model::Tractogram& tractogram, const FibletOptions& options);

/// The same of points. \param offsets  fibre f has the points [offsets[f], offsets[f + 1]), maybe none
model::FibletSet encodeFiblets(std::span<const glm::vec3> points, std::span<const std::uint64_t> offsets,
                               const FibletOptions& options);

}  // namespace radiata
