// Streamlines for experiments.
#pragma once

#include <string>
#include <vector>

#include "model/tractogram.h"
#include "tools/lab/experiment.h"

namespace radiata::lab {

struct TractScene {
    std::string name;
    model::Tractogram tractogram;
};

/// Generated streamlines of 0.1 mm steps with turns of up to 7.2 degrees, as iFOD1 makes them at the paper's voxel size and
/// step; and, if RADIATA_DATA names the folder of real data, its iFOD1 (up to 15 degrees) and SD_STREAM streamlines. \param
/// fibres  at most so many of each
std::vector<TractScene> tractScenes(std::size_t fibres);

}  // namespace radiata::lab
