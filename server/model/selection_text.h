// Selections as people and scripts write them:
//
//   any sphere(-20, 4, 12, 8) and not both_ends mask(csf) and length(20, 250)
//
// not binds before and, and before or; parentheses group. A region alone means "any". Regions, world mm:
//   sphere(x, y, z, radius)   box(x0, y0, z0, x1, y1, z1)   plane(px, py, pz, nx, ny, nz): the side against the normal
//   ellipsoid(x, y, z, a, b, c)   ellipsoid(x, y, z, and three half axes of three numbers each)
//   mask(dataset)   mask(dataset, threshold)   mesh(dataset)
// with one of any, all, either_end, both_ends before it, or several in order(region, region, ...). Filters:
//   length(low, high)   column(name, low, high)   column(name, low, high, mean|least|largest)   group(name)
//   fibres(3, 10-20)   share(0.1)   share(0.1, seed)   sample(1000)   sample(1000, seed)   everything
// Names with other characters than letters, digits, '_', '.' and '-' stand in double quotes. Bounds may be inf or -inf.
#pragma once

#include <string>
#include <string_view>

#include "model/selection.h"

namespace radiata::model {

/// \throws Error(kInvalidArgument) naming the place, what stands there and what would be right
Selection parseSelection(std::string_view text);
/// One region alone, such as "sphere(0, 0, 0, 5)". \throws as parseSelection()
FibreRegion parseRegion(std::string_view text);

/// The same region in the same text whatever way it was written; numbers keep all their bits.
std::string regionText(const FibreRegion& region);

}  // namespace radiata::model
