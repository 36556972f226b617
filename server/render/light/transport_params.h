// What light transport on the level sets of a volume reads, by texels or by pixels.
#pragma once

#include "model/illumination.h"
#include "shaders/shared/lattice.glsl"
#include "store/volume_dataset.h"

namespace radiata::render {

/// Volume, its axes in mm and bounces; texels, light and colour are left at 0.
shader::LatticeParams transportParams(const store::VolumeDataset& volume, const model::Illumination& light);

}  // namespace radiata::render
