// Nearly even directions on the sphere with a proven covering radius: a subdivided icosahedron.
#pragma once

#include <vector>

#include <glm/glm.hpp>

namespace radiata {

struct SphereGrid {
    std::vector<glm::dvec3> directions;  ///< unit; with `half` one of each antipodal pair
    double covering_radius = 0;  ///< radians; no direction is farther from all of them (and their antipodes, with `half`)
};

/// The coarsest grid whose covering radius is at most `radius_max` (radians, > 0).
SphereGrid sphereGrid(double radius_max, bool half);

}  // namespace radiata
