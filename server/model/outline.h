// An outline drawn on a picture, and the pixels in it.
#pragma once

#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace radiata::model {

constexpr std::size_t kOutlinePointsMax = 4096;

/// The pixels of a picture whose centres lie in an outline.
struct OutlinePixels {
    glm::ivec2 first{0}, size{0};  ///< of the rows and columns that hold them all; size 0: there are none
    std::vector<bool> inside;      ///< size.x * size.y, row by row
};

/// \param outline  pixels right and down, pixel i from i to i + 1; closed, inside where it winds an odd number of times around;
/// of two
///                 points the box between them, of one the pixel it lies in \param picture  columns and rows
/// \throws Error(kInvalidArgument) for no points, too many, and such that are not finite
OutlinePixels pixelsIn(std::span<const glm::dvec2> outline, const glm::ivec2& picture);

}  // namespace radiata::model
