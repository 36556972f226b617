// Fibres and regions by brute force, in double: every segment of every fibre against every region, by other formulas than
// build/region_volume.h. Convex regions by the interval of a segment inside them (quadratic equation, clipping), masks by the
// pieces between a segment's crossings with voxel planes.
#pragma once

#include <functional>
#include <span>
#include <utility>
#include <vector>

#include <glm/glm.hpp>

#include "model/scalar_image.h"
#include "model/selection.h"

namespace radiata::reference {

/// Parts of a segment inside a region, as ascending intervals of its parameter from 0 to 1.
/// \param mask  of kMask regions
std::vector<std::pair<double, double>> insideIntervals(const model::FibreRegion& region, const model::ScalarImage* mask,
                                                       const glm::dvec3& a, const glm::dvec3& b);

struct FibreInRegion {
    bool meets = false, leaves = false, first_end = false, last_end = false;
};

/// \param points  of one fibre, world mm; none gives nothing
FibreInRegion fibreInRegion(const model::FibreRegion& region, const model::ScalarImage* mask,
                            std::span<const glm::dvec3> points);

}  // namespace radiata::reference
