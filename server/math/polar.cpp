#include "math/polar.h"

#include <cmath>

#include "base/error.h"

namespace radiata {
namespace {

double frobenius(const glm::dmat3& m) { return std::sqrt(glm::dot(m[0], m[0]) + glm::dot(m[1], m[1]) + glm::dot(m[2], m[2])); }

}  // namespace

glm::dmat3 orthogonalPolarFactor(const glm::dmat3& matrix) {
    constexpr int kStepsMax = 64;
    const double size = frobenius(matrix);
    glm::dmat3 q = matrix / size;
    if (!std::isfinite(size) || !(size > 0) || !(std::abs(glm::determinant(q)) > 1e-30)) {
        throw Error(Code::kInvalidArgument, "the matrix is singular or not finite; it has no rotation");
    }
    for (int step = 0; step < kStepsMax; ++step) {
        const glm::dmat3 inverse = glm::transpose(glm::inverse(q));
        const double scale = std::sqrt(frobenius(inverse) / frobenius(q));
        const glm::dmat3 next = 0.5 * (scale * q + inverse / scale);
        const double change = frobenius(next - q);
        q = next;
        if (change < 1e-15) break;
    }
    return q;
}

}  // namespace radiata
