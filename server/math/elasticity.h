// Tensors of order 4 from 6x6 matrices, as elasticity writes them.
#pragma once

#include <span>
#include <string_view>
#include <vector>

namespace radiata {

/// Rows and columns stand for the index pairs 11, 22, 33, 23, 13, 12. What factor the last three carry is the convention:
///  kVoigtStiffness   M_IJ = C_ijkl, no factor (stress = M * strain with engineering shear strains)
///  kVoigtCompliance  M_IJ = S_ijkl, times 2 for each of I, J that is a shear pair (so M_44 = 4 S_2323)
///  kMandel           M_IJ = T_ijkl, times sqrt 2 for each of I, J that is a shear pair (stiffness and compliance alike)
enum class ElasticityConvention { kVoigtStiffness, kVoigtCompliance, kMandel };

/// The symmetric part of the tensor of order 4 that a matrix stands for (math/cartesian_tensor.h): 15 components. What the
/// glyph does not show is gone from it: the part of the matrix that is not symmetric, and the 6 numbers by which C_iijj and
/// C_ijij differ. \param matrix  36 values, row by row
std::vector<double> symmetricFromMatrix(std::span<const double> matrix, ElasticityConvention convention);

/// 36 values from the 21 on and above the diagonal, row by row.
std::vector<double> fullMatrix(std::span<const double> upper);

}  // namespace radiata
