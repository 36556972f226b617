// Distances to a region on a grid of points, for colours.
#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "build/region_volume.h"

namespace radiata {

struct DistanceGrid {
    glm::dvec3 origin_mm{0};  ///< node 0, world
    double step_mm = 1;
    glm::ivec3 size{2};     ///< nodes, at least 2 along each axis
    std::vector<float> mm;  ///< x fastest; 0 inside of the region
};

/// Covers a box of the world. Each node's distance is off by at most sqrt(3) / 2 steps where boxes that the region calls
/// unknown are crossed by it, and never too large by more; so what is interpolated is off by less than two steps. \param
/// nodes_max  along the longest axis \throws Error(kInvalidArgument) if nothing of the region is within 16 times the box's size
DistanceGrid distanceGrid(const RegionVolume& region, const glm::dvec3& low, const glm::dvec3& high, int nodes_max = 128);

}  // namespace radiata
