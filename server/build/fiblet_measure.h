// What is found out about a tractogram before it is encoded: where it lies, whether its steps are constant, and if not, which
// step to walk with.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>

#include "model/fiblet_set.h"
#include "model/tractogram.h"

namespace radiata {

using OpenTractogram = std::function<std::unique_ptr<model::TractogramSource>()>;
/// Called now and then with a share of the work from 0 to 1; may throw to end it.
using FibletProgress = std::function<void(double share)>;

/// How much of the file has been read, from 0 to 1; 0 if unknown.
inline double shareRead(const model::TractogramSource& source) {
    return source.bytesTotal() > 0 ? double(source.bytesRead()) / double(source.bytesTotal()) : 0;
}

struct FibletMeasures {
    model::TractogramMeasures all;
    double longest_last_mm = 0;   ///< of all fibres' last segments
    double largest_turn = 0;      ///< between segments, rad
    double longest_reach_mm = 0;  ///< largest coordinate's absolute value

    /// The step if the points can stay: all segments alike within what rounding does to coordinates and 1 / 16 of the bound,
    /// last ones no longer.
    double keptStepMm(double bound_um) const;
};

/// \param batch_points  that are in memory at once, about; the result does not depend on it
/// \throws Error(kInvalidArgument) naming fibre and point that is not finite, and as the source
FibletMeasures measureTractogram(model::TractogramSource& source, std::size_t batch_points, const FibletProgress& progress);

struct WalkWish {
    double step_mm = 0;     ///< to be used as it is, and held against the bound; 0: to be chosen
    double longest_mm = 0;  ///< of the steps to choose from
    double bound_um = 0;    ///< of the vertices' distances from the walked lines
};

struct WalkChoice {
    double step_mm = 0;
    model::FibletErrors errors;  ///< of the vertices against the walked lines
};

/// The largest of a row of steps, from the mean segment's length downwards, that keeps all vertices within the bound. The row
/// ends below the bound, which such a step holds, or where a fibre would have too many.
/// \throws Error(kInvalidArgument) naming the fibre that no step, or not this one, holds within the bound
WalkChoice chooseWalk(model::TractogramSource& source, const FibletMeasures& measures, const WalkWish& wish,
                      std::size_t batch_points, const FibletProgress& progress);

}  // namespace radiata
