// Ranges of a scalar volume by bricks, so that rays leave out what has no isovalue in it, whatever the isovalue.
// Source: Parker et al. 1998, Sec. 2 (macrocells); sizes in shaders/shared/isosurface.glsl.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "model/scalar_image.h"

namespace radiata {

/// Boxes of cells, i fastest; the last ones along an axis may be smaller.
struct BrickLevel {
    glm::ivec3 size{0};             ///< boxes
    std::vector<glm::vec2> ranges;  ///< least and largest number among the samples of all corners; (inf, -inf): there is none
};

struct VolumeBricks {
    BrickLevel bricks;           ///< 8^3 cells
    BrickLevel blocks;           ///< 64^3 cells
    std::uint64_t no_value = 0;  ///< voxels that are NaN, infinite or beyond 3e38
    float value_min = 0;         ///< of the others; 0 if there are none
    float value_max = 0;
};

/// Whether a sample is a number that a surface can be made of.
bool hasValue(float sample);

/// \throws Error(kInvalidArgument) unless the volume has at least two samples along each axis, with its size
VolumeBricks buildVolumeBricks(const model::ScalarImage& image);

}  // namespace radiata
