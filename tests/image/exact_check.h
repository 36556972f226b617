// Holds the exact outputs of a frame against the double-precision reference, on a sample of its pixels.
#pragma once

#include <ostream>

#include "model/frame.h"
#include "model/sh_image.h"

namespace radiata::test {

struct ExactCheck {
    int checked = 0;    ///< pixels with a hit, decided
    int empty = 0;      ///< pixels without one, decided
    int undecided = 0;  ///< grazing, at a clip plane, or two glyphs within 1e-4 mm
    int wrong_id = 0;
    int wrong_depth = 0;     ///< or position, beyond the bound below
    int wrong_normal = 0;    ///< beyond 0.1 degree, plus what float positions leave open near the glyph's centre
    int without_steps = 0;   ///< hits that no step of the march was counted for
    double worst_depth = 0;  ///< as a share of the bound
    double worst_normal_deg = 0;
    int wrong() const { return wrong_id + wrong_depth + wrong_normal + without_steps; }
};
std::ostream& operator<<(std::ostream& out, const ExactCheck& check);

/// The frame's request must have one layer with absolute scale that shows all voxels of `image`, and all outputs.
/// Bound of depth and position: 2e-5 radii of the glyph, plus the rounding of float coordinates in the scene (4e-7 of its
/// extent, times how much faster the hit moves than the ray, which is 1 head-on). \param pixels  about how many are looked at,
/// evenly spread
ExactCheck checkAgainstReference(const model::Frame& frame, const model::ShImage& image, int pixels);

}  // namespace radiata::test
