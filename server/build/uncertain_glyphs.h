// Glyphs that say how uncertain other glyphs are: where no image of them was measured, they are made from standard deviations
// or by a recipe. A region of uncertainty is approximated by a second glyph (Peters et al. 2023, Sec. 4.3).
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "model/sh_image.h"

namespace radiata {

/// How Peters et al. 2023, Sec. 5 made glyphs of uncertainty for data that had none.
struct UncertaintyRecipe {
    double constant =
        1.7;  ///< the coefficient of the constant part is multiplied by this, so that positive parts grow; 0 to 100
    double deviation = 0.05;  ///< each coefficient is multiplied by a normal variate of mean 1 and this deviation; 0 to 100
    std::uint64_t seed = 1;
};

/// The image by the recipe. Each variate depends on seed, voxel and coefficient only, whatever the number of threads and
/// whatever other voxels hold. \param progress  told now and then how many voxels are done, from any thread; may be empty
/// \throws Error(kInvalidArgument) for a constant or deviation out of range
model::ShImage uncertaintyByRecipe(const model::ShImage& mean, const UncertaintyRecipe& recipe,
                                   const std::function<void(std::size_t voxels)>& progress = {});

/// Outer glyphs from standard deviations of the coefficients, taken as independent. The function f has then in direction d
/// the standard deviation s(d) = sqrt(sum_i (s_i Y_i(d))^2), and the outer glyph is f(d) + factor S(d), where S is the
/// least-squares fit to s over the sphere in the bands of the image, so that the outer surface is a glyph too: a normal
/// variate stays below f(d) + factor s(d) with the probability of `factor` deviations. S = s where deviations are equal, as s
/// is then the same in all directions; |S - s| is at most 7 % of the largest s for deviations that differ by 20 % at bands to
/// 8 and more (16 % at band 2), and 26 % for any between 0 and 1 (65 %); tests/unit/build/uncertain_glyphs_test.cpp.
/// \param slots       of the mean's voxels that are wanted; the result holds these, in this order
/// \param deviations  on the same grid, one for each coefficient of the mean, in world axes; 0 in voxels that it lacks.
///                    Conventions differ by signs, which deviations do not have: it must be read as what it is.
/// \param lmax        bands above are left out, of both; an even layout takes the band below an odd one
/// \throws Error(kInvalidArgument) naming the images: other grid, other coefficients, voxel axes, or a deviation that is
///         negative or not finite, with its voxel
model::ShImage outerGlyphs(const model::ShImage& mean, std::span<const std::uint32_t> slots, const model::ShImage& deviations,
                           double factor, int lmax);

/// \throws Error(kInvalidArgument) unless both images have the same voxels: sizes equal, matrices up to 1e-3 voxels
void checkSameGrid(const model::ShImage& image, const model::ShImage& uncertainty);

constexpr std::uint32_t kNoVoxel = 0xffffffffU;

/// For each slot, the slot of the same voxel in another image of the same grid, or kNoVoxel.
std::vector<std::uint32_t> matchVoxels(const model::ShImage& image, std::span<const std::uint32_t> slots,
                                       const model::ShImage& other);

}  // namespace radiata
