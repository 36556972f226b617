// Streamlines for experiments.
#pragma once

#include <string>
#include <vector>

#include "model/fiblet_set.h"
#include "model/frame.h"
#include "model/tractogram.h"
#include "tools/lab/experiment.h"

namespace radiata::lab {

struct TractScene {
    std::string name;
    model::Tractogram tractogram;
    bool checked = false;  ///< the codec's figures are asked of it
};

/// Generated streamlines of 0.1 mm steps with turns of up to 7.2 degrees, as iFOD1 makes them at the paper's voxel size and
/// step; and, if RADIATA_DATA names the folder of real data, its iFOD1 (up to 15 degrees) and SD_STREAM streamlines. \param
/// fibres  at most so many of each \param own_file  comes second, unless empty; it and the generated ones are checked
std::vector<TractScene> tractScenes(std::size_t fibres, const std::string& own_file = {});

/// Fibres of 800 points, 0.1 mm apart, in a ball of brain size (140 mm), that turn a little at each step and are turned back at
/// the surface: dense outside and inside. Made while they are encoded, so that only fiblets take memory.
model::FibletSet ballOfFibres(std::size_t fibres);

/// A frame of one layer of fibres at 16 : 9, one sample, without marks; the camera is left as it is.
model::FrameRequest fibreFrame(int height, const std::string& dataset);

}  // namespace radiata::lab
