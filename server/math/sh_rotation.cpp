#include "math/sh_rotation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "base/error.h"
#include "math/gauss_legendre.h"
#include "math/sh_evaluate.h"

namespace radiata {
namespace {

void checkOrthogonal(const glm::dmat3& matrix) {
    const glm::dmat3 rest = glm::transpose(matrix) * matrix - glm::dmat3(1.0);
    for (int c = 0; c < 3; ++c) {
        for (int r = 0; r < 3; ++r) {
            if (!(std::abs(rest[c][r]) < 1e-9)) {
                throw Error(Code::kInvalidArgument, "ShRotation: the matrix is not orthogonal (off by " +
                                                        std::to_string(rest[c][r]) + "; at most 1e-9 is)");
            }
        }
    }
}

}  // namespace

ShRotation::ShRotation(ShLayout layout, const glm::dmat3& orthogonal) : layout_(layout) {
    checkOrthogonal(orthogonal);
    std::size_t size = 0;
    for (int l = 0; l <= layout.lmax; l += layout.step()) size += static_cast<std::size_t>((2 * l + 1) * (2 * l + 1));
    bands_.assign(size, 0.0);

    // Products of two harmonics have degree 2 lmax: lmax + 1 nodes in z and 2 lmax + 1 azimuths integrate them exactly.
    const int azimuths = 2 * layout.lmax + 1;
    std::vector<double> turned(layout.count());
    std::vector<double> source(layout.count());
    for (const auto& [z, weight] : gaussLegendre(layout.lmax + 1)) {
        const double radius = std::sqrt((1 - z) * (1 + z));
        for (int i = 0; i < azimuths; ++i) {
            const double phi = 2 * std::numbers::pi * i / azimuths;
            const glm::dvec3 direction(radius * std::cos(phi), radius * std::sin(phi), z);
            evaluateSh(layout, direction, turned);
            evaluateSh(layout, glm::transpose(orthogonal) * direction, source);
            const double area = weight * 2 * std::numbers::pi / azimuths;
            double* band = bands_.data();
            for (int l = 0; l <= layout.lmax; l += layout.step()) {
                for (int row = -l; row <= l; ++row) {
                    const double factor = area * turned[layout.index(l, row)];
                    for (int column = -l; column <= l; ++column) *band++ += factor * source[layout.index(l, column)];
                }
            }
        }
    }
}

void ShRotation::apply(std::span<double> coefficients) const {
    if (coefficients.size() != layout_.count()) {
        throw Error(Code::kInternal, "ShRotation: " + std::to_string(coefficients.size()) + " coefficients for lmax " +
                                         std::to_string(layout_.lmax));
    }
    std::array<double, 2 * kLmaxLimit + 1> result;
    const double* band = bands_.data();
    for (int l = 0; l <= layout_.lmax; l += layout_.step()) {
        const auto count = static_cast<std::size_t>(2 * l + 1);
        const auto part = coefficients.subspan(layout_.index(l, -l), count);
        for (std::size_t row = 0; row < count; ++row) {
            result[row] = 0;
            for (std::size_t column = 0; column < count; ++column) result[row] += *band++ * part[column];
        }
        std::copy_n(result.begin(), count, part.begin());
    }
}

}  // namespace radiata
