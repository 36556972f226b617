// A ball with deep folds, somewhat like a cortex: a test volume with much surface, of any size and with a known formula.
#pragma once

#include "model/scalar_image.h"

namespace radiata {

/// size^3 voxels of 1 mm around the origin: 100 (1 - r / R) + 18 g with R = 0.42 size, r the distance from the centre and g the
/// gyroid sin x cos y + sin y cos z + sin z cos x of wave length 0.22 size. Isovalue 30 has folds, 60 is a lump inside it.
/// \throws Error(kInvalidArgument) for a size outside 2 to 2048
model::ScalarImage foldedBall(int size);

}  // namespace radiata
