// Ellipsoids of tensors of order 2: the customary glyph of diffusion tensors, whose half axes are the eigenvalues along the
// eigenvectors. (The Reynolds glyph of the same tensor, x^T D x, is a peanut that touches this ellipsoid at the ends of the
// axes and lies outside of it elsewhere.)
#pragma once

#include <array>
#include <span>

#include <glm/glm.hpp>

namespace radiata {

/// Half axes below this share of the longest are drawn with it: a tensor without volume is a disc or a needle, not nothing.
constexpr double kEllipsoidFlattest = 1e-3;

/// The surface { D u : |u| = 1 } with D's eigenvalues taken as |lambda|; noise makes some of them negative.
struct Ellipsoid {
    std::array<float, 6> inverse{};  ///< of that matrix: xx, xy, xz, yy, yz, zz
    glm::vec3 extent{0};             ///< half edges of its box, enlarged by 1e-6; the box is symmetric about the centre
    float radius = 0;                ///< longest half axis, enlarged by 1e-6; 0: the tensor is zero and there is no ellipsoid
    float longest = 0;               ///< that half axis itself
};

/// \param components  xx, xy, xz, yy, yz, zz; finite
Ellipsoid ellipsoidOf(std::span<const float> components);

}  // namespace radiata
