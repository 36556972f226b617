// Rotations of spherical-harmonics coefficients by the two ways that Wyman et al. 2006 (appendix) name: the recursion of Ivanic
// and Ruedenberg, and Euler angles. Full layouts, internal convention. math/sh_rotation.h does the same by projection and is
// the test of both.
#pragma once

#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "math/sh_layout.h"

namespace radiata {

/// Matrices of bands 0 to lmax, each (2l+1) x (2l+1), row by row. A row is a turned function's coefficient (l, m), m from -l.
using BandMatrices = std::vector<std::vector<double>>;

/// Each band from the one below and band 1, without angles.
/// \param rotation  orthogonal with determinant 1; g(rotation * d) = f(d)
/// \throws Error(kInvalidArgument) for a matrix that is no rotation
/// |error| < 1e-12 for bands to 16 (tests/unit/math/sh_rotation_recursive_test.cpp)
/// Source: Ivanic & Ruedenberg 1996, Eq. 8.1 and Tables 1 and 2, with the corrections of 1998.
/// Note: in Table 3a of Wyman et al. the denominators "(i+r)(i-r)" are (i+t)(i-t); rows and columns of band 1 are y, z, x.
BandMatrices ivanicRuedenberg(int lmax, const glm::dmat3& rotation);

/// rotation = Rz(alpha) Ry(beta) Rz(gamma); turns about z are 2 x 2 blocks, and the one about y is a turn about z between two
/// quarter turns about x, whose matrices are constants. \throws, error bound  as ivanicRuedenberg() Source: Green 2003; Wyman
/// et al. 2006, appendix.
BandMatrices zyzRotation(int lmax, const glm::dmat3& rotation);

/// Coefficients of one function times the matrices. \param coefficients  (lmax + 1)^2 values
void applyBands(const BandMatrices& bands, std::span<double> coefficients);

}  // namespace radiata
