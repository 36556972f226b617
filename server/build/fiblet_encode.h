// From streamlines to fiblets.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include <glm/glm.hpp>

#include "model/fiblet_set.h"

namespace radiata {

struct FibletOptions {
    double bound_um = 10;  ///< largest distance between a point and its decoded one
    double step_mm = 0;    ///< of all segments but each fibre's last; 0: the mean of what is there
    std::string source = "memory";
};

/// Encodes fibres whose segments all have one length, but for each fibre's last, which may be shorter. Equal input gives equal
/// bytes, whatever the number of threads. \param points   world mm; finite \param offsets  fibre f has the points [offsets[f],
/// offsets[f + 1]), maybe none \throws Error(kInvalidArgument) naming the fibre if the bound cannot be held, a point is not
/// finite or a fibre has more than
///         63 * 4096 segments
model::FibletSet encodeFiblets(std::span<const glm::vec3> points, std::span<const std::uint64_t> offsets,
                               const FibletOptions& options);

}  // namespace radiata
