// Frames against the double-precision reference: the nearest hit over all glyphs of the scene, pixel by pixel.
#pragma once

#include <cstddef>
#include <vector>

#include <glm/glm.hpp>

#include "model/frame.h"
#include "store/store.h"
#include "tools/lab/measure.h"

namespace radiata::lab {

/// A depth off by more than this, in radii of the glyph that is hit, makes a pixel wrong, as do a missed and a false hit.
constexpr double kWrongRadii = 2e-3;

struct Errors {
    std::size_t compared = 0;  ///< pixels: a regular sample, and those where two methods differ by more than kWrongRadii
    std::size_t left_out = 0;  ///< their first hit comes, goes or moves by over 2e-4 radii if the ray moves by 1e-5
    std::size_t missed = 0, false_hits = 0;
    std::size_t wrong = 0;                                  ///< the two before and wrong depths, over all that were compared
    double wrong_share = 0;                                 ///< of the regular sample
    double depth_p50 = 0, depth_p99 = 0, depth_max = 0;     ///< radii, of pixels that both hit, in the regular sample
    double normal_p50 = 0, normal_p99 = 0, normal_max = 0;  ///< degrees, same pixels
};

/// One entry for each measured frame.
/// \param request  the scene's layers must all be glyphs of spherical harmonics; camera without clip planes
/// \param sample   pixels of the regular sample, about
std::vector<Errors> compareWithReference(store::Store& store, const model::FrameRequest& request,
                                         const std::vector<Measured>& measured, int sample);

}  // namespace radiata::lab
