// Fiblets decoded again, for whatever takes streamlines: export, comparison, other formats.
#pragma once

#include <memory>

#include "model/fiblet_set.h"
#include "model/tractogram.h"

namespace radiata {

/// Hands out the fibres of a set that outlives the source, with their columns and groups. Points are within the set's error of
/// those that were encoded; values of points are within 1 / 508 of their fiblet's range.
std::unique_ptr<model::TractogramSource> sourceOf(const model::FibletSet& set);

}  // namespace radiata
