#include "math/elasticity.h"

#include <cmath>
#include <numbers>
#include <string>

#include "base/error.h"
#include "math/cartesian_tensor.h"

namespace radiata {
namespace {

/// Row of the matrix for a pair of indices.
constexpr int kPair[3][3] = {{0, 5, 4}, {5, 1, 3}, {4, 3, 2}};

double shearFactor(ElasticityConvention convention) {
    switch (convention) {
        case ElasticityConvention::kVoigtStiffness:
            return 1;
        case ElasticityConvention::kVoigtCompliance:
            return 2;
        case ElasticityConvention::kMandel:
            return std::numbers::sqrt2;
    }
    return 1;
}

}  // namespace

std::vector<double> symmetricFromMatrix(std::span<const double> matrix, ElasticityConvention convention) {
    if (matrix.size() != 36) throw Error(Code::kInternal, "elasticity: " + std::to_string(matrix.size()) + " values, not 36");
    const double shear = shearFactor(convention);
    std::vector<double> entries;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            for (int k = 0; k < 3; ++k) {
                for (int l = 0; l < 3; ++l) {
                    const double factor = (i == j ? 1.0 : shear) * (k == l ? 1.0 : shear);
                    entries.push_back(matrix[static_cast<std::size_t>(6 * kPair[i][j] + kPair[k][l])] / factor);
                }
            }
        }
    }
    return symmetricPart(4, entries);
}

std::vector<double> fullMatrix(std::span<const double> upper) {
    if (upper.size() != 21) throw Error(Code::kInternal, "elasticity: " + std::to_string(upper.size()) + " values, not 21");
    std::vector<double> matrix(36);
    std::size_t next = 0;
    for (std::size_t row = 0; row < 6; ++row) {
        for (std::size_t column = row; column < 6; ++column) {
            matrix[6 * row + column] = matrix[6 * column + row] = upper[next++];
        }
    }
    return matrix;
}

}  // namespace radiata
