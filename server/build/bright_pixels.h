// The bright pixels of an environment map, apart from the rest, so that paths look for them.
// Source: the alias method of Walker 1977 as built by Vose 1991; cutting a map at a cap takes the place of multiple importance
// sampling: either part is sampled in its own way, and nothing is counted twice.
#pragma once

#include <vector>

#include "model/illumination.h"
#include "shaders/shared/lattice.glsl"

namespace radiata {

struct BrightPixels {
    float cap = 0;      ///< luminance: four times the map's mean
    double weight = 0;  ///< what pixels have above it, times their solid angle, summed
    std::vector<shader::BrightPixel>
        table;  ///< an entry by even chance, then one of its two pixels; empty if none is above the cap
};

BrightPixels brightPixels(const model::EnvironmentMap& map);

}  // namespace radiata
