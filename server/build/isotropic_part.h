// A constant added to glyphs, so that they do not touch their own centre.
// Source: Hlawitschka et al., "Overcoming the singularity at the origin", Fig. 2 ("a basic isotropic component").
#pragma once

#include <cstdint>
#include <span>

#include "model/sh_image.h"

namespace radiata {

/// Some voxels of an image with `amplitude` added to the function in every direction.
/// \param slots  of the image's voxels that are wanted, ascending; the result holds these, in this order
model::ShImage withIsotropicPart(const model::ShImage& image, std::span<const std::uint32_t> slots, double amplitude);

}  // namespace radiata
