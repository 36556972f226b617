// The coverage buffer of a depth picture in double, texel against texel. Twin of shaders/fiblet/coverage_dilate.comp.
#pragma once

#include <span>
#include <vector>

#include "model/camera.h"

namespace radiata::reference {

/// Depth behind which nothing can be seen in a texel's middle that lies within `reach_mm` of what hides it, by balls about the
/// middles of all texels whose radius is the reach and half a texel's diagonal. \param depths    from the eye along the line of
/// sight, mm: the farthest of each texel's pixels, finite; rows first \param texel_px  pixels along a texel's edge; the last
/// column and row may reach beyond the picture
std::vector<double> dilatedDepths(std::span<const double> depths, int columns, const model::Camera& camera, int width,
                                  int height, int texel_px, double reach_mm);

}  // namespace radiata::reference
