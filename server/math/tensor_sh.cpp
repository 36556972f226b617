#include "math/tensor_sh.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "base/error.h"
#include "math/cartesian_tensor.h"
#include "math/gauss_legendre.h"
#include "math/sh_evaluate.h"

namespace radiata {
namespace {

/// Gauss-Jordan elimination with the largest pivot of each column.
std::vector<double> inverse(std::vector<double> matrix, std::size_t n) {
    std::vector<double> result(n * n, 0.0);
    for (std::size_t i = 0; i < n; ++i) result[i * n + i] = 1;
    for (std::size_t column = 0; column < n; ++column) {
        std::size_t pivot = column;
        for (std::size_t row = column; row < n; ++row) {
            if (std::abs(matrix[row * n + column]) > std::abs(matrix[pivot * n + column])) pivot = row;
        }
        for (std::size_t i = 0; i < n; ++i) {
            std::swap(matrix[column * n + i], matrix[pivot * n + i]);
            std::swap(result[column * n + i], result[pivot * n + i]);
        }
        const double scale = 1 / matrix[column * n + column];
        for (std::size_t i = 0; i < n; ++i) {
            matrix[column * n + i] *= scale;
            result[column * n + i] *= scale;
        }
        for (std::size_t row = 0; row < n; ++row) {
            const double factor = matrix[row * n + column];
            if (row == column || factor == 0) continue;
            for (std::size_t i = 0; i < n; ++i) {
                matrix[row * n + i] -= factor * matrix[column * n + i];
                result[row * n + i] -= factor * result[column * n + i];
            }
        }
    }
    return result;
}

std::vector<double> times(const std::vector<double>& matrix, std::span<const double> vector) {
    std::vector<double> result(vector.size(), 0.0);
    for (std::size_t row = 0; row < vector.size(); ++row) {
        for (std::size_t i = 0; i < vector.size(); ++i) result[row] += matrix[row * vector.size() + i] * vector[i];
    }
    return result;
}

}  // namespace

TensorSh::TensorSh(int order) : order_(order), layout_{order, order % 2 != 0} {
    if (order < kTensorOrderMin || order > kTensorOrderMax) {
        throw Error(Code::kUnsupported, "a tensor of order " + std::to_string(order) + " was given; orders " +
                                            std::to_string(kTensorOrderMin) + " to " + std::to_string(kTensorOrderMax) +
                                            " are read");
    }
    for (int l = order % 2; l <= order; l += 2) {
        for (int m = -l; m <= l; ++m) used_.push_back(layout_.index(l, m));
    }
    const std::size_t n = used_.size();
    const std::vector<TensorPowers> components = symmetricComponents(order);
    to_sh_.assign(n * n, 0.0);
    // Harmonic times monomial has degree 2 n: n + 1 nodes in z and 2 n + 1 azimuths integrate it exactly.
    const int azimuths = 2 * order + 1;
    std::vector<double> harmonics(layout_.count()), unit(n, 0.0);
    for (const auto& [z, weight] : gaussLegendre(order + 1)) {
        const double radius = std::sqrt((1 - z) * (1 + z));
        for (int i = 0; i < azimuths; ++i) {
            const double phi = 2 * std::numbers::pi * i / azimuths;
            const glm::dvec3 direction(radius * std::cos(phi), radius * std::sin(phi), z);
            evaluateSh(layout_, direction, harmonics);
            const double area = weight * 2 * std::numbers::pi / azimuths;
            for (std::size_t column = 0; column < n; ++column) {
                unit[column] = 1;
                const double value = area * evaluateTensor(order, unit, direction);
                unit[column] = 0;
                for (std::size_t row = 0; row < n; ++row) to_sh_[row * n + column] += value * harmonics[used_[row]];
            }
        }
    }
    // Inverted with each component in units of 1 / sqrt(multiplicity), where the matrix is nearly orthogonal.
    std::vector<double> balanced = to_sh_;
    for (std::size_t row = 0; row < n; ++row) {
        for (std::size_t column = 0; column < n; ++column)
            balanced[row * n + column] /= std::sqrt(multiplicity(components[column]));
    }
    to_tensor_ = inverse(std::move(balanced), n);
    for (std::size_t row = 0; row < n; ++row) {
        for (std::size_t column = 0; column < n; ++column)
            to_tensor_[row * n + column] /= std::sqrt(multiplicity(components[row]));
    }
}

void TensorSh::toSh(std::span<const double> components, std::span<double> coefficients) const {
    if (components.size() != used_.size() || coefficients.size() != layout_.count()) {
        throw Error(Code::kInternal,
                    "TensorSh: " + std::to_string(components.size()) + " components of order " + std::to_string(order_));
    }
    const std::vector<double> values = times(to_sh_, components);
    std::ranges::fill(coefficients, 0.0);
    for (std::size_t i = 0; i < used_.size(); ++i) coefficients[used_[i]] = values[i];
}

void TensorSh::toTensor(std::span<const double> coefficients, std::span<double> components) const {
    if (components.size() != used_.size() || coefficients.size() != layout_.count()) {
        throw Error(Code::kInternal,
                    "TensorSh: " + std::to_string(coefficients.size()) + " coefficients for order " + std::to_string(order_));
    }
    std::vector<double> values;
    for (const std::size_t index : used_) values.push_back(coefficients[index]);
    for (std::size_t i = 0; i < coefficients.size(); ++i) {
        if (coefficients[i] != 0 && !std::ranges::binary_search(used_, i)) {
            throw Error(Code::kInternal, "TensorSh: coefficient " + std::to_string(i) + " belongs to a band that order " +
                                             std::to_string(order_) + " does not have");
        }
    }
    std::ranges::copy(times(to_tensor_, values), components.begin());
}

}  // namespace radiata
