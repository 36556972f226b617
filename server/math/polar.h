// The rotation (or reflection) inside a matrix.
#pragma once

#include <glm/glm.hpp>

namespace radiata {

/// The orthogonal factor Q of the polar decomposition A = Q P, P symmetric positive definite: the orthogonal matrix nearest to
/// A. det Q has the sign of det A, so a mirroring matrix gives a mirroring Q. \param matrix  invertible, with entries of any
/// scale \return |Q Q^T - I| < 1e-14 for condition numbers to 1e6 (tests/unit/math/polar_test.cpp) \throws
/// Error(kInvalidArgument) for a singular or non-finite matrix Source: Higham 1986, "Computing the polar decomposition with
/// applications", scaled Newton iteration (Sec. 3).
glm::dmat3 orthogonalPolarFactor(const glm::dmat3& matrix);

}  // namespace radiata
