#include "math/cartesian_tensor.h"

#include <array>
#include <cmath>
#include <string>

#include "base/error.h"

namespace radiata {
namespace {

double factorial(int n) {
    double product = 1;
    for (int i = 2; i <= n; ++i) product *= i;
    return product;
}

double power(double base, int exponent) {
    double product = 1;
    for (int i = 0; i < exponent; ++i) product *= base;
    return product;
}

void requireCount(std::size_t given, std::size_t wanted, const char* what) {
    if (given != wanted) {
        throw Error(Code::kInternal,
                    std::string(what) + ": " + std::to_string(given) + " values in place of " + std::to_string(wanted));
    }
}

/// Coefficients of monomials of one degree, multiplied by the linear form (form . x): one degree more.
std::vector<double> timesForm(int degree, const std::vector<double>& polynomial, const glm::dvec3& form) {
    std::vector<double> product(symmetricCount(degree + 1), 0.0);
    const std::vector<TensorPowers> monomials = symmetricComponents(degree);
    for (std::size_t i = 0; i < monomials.size(); ++i) {
        const TensorPowers p = monomials[i];
        product[symmetricIndex({p.x + 1, p.y, p.z})] += polynomial[i] * form.x;
        product[symmetricIndex({p.x, p.y + 1, p.z})] += polynomial[i] * form.y;
        product[symmetricIndex({p.x, p.y, p.z + 1})] += polynomial[i] * form.z;
    }
    return product;
}

}  // namespace

std::vector<TensorPowers> symmetricComponents(int order) {
    std::vector<TensorPowers> components;
    components.reserve(symmetricCount(order));
    for (int x = order; x >= 0; --x) {
        for (int y = order - x; y >= 0; --y) components.push_back({x, y, order - x - y});
    }
    return components;
}

double multiplicity(TensorPowers powers) {
    return factorial(powers.x + powers.y + powers.z) / (factorial(powers.x) * factorial(powers.y) * factorial(powers.z));
}

std::vector<double> symmetricPart(int order, std::span<const double> entries) {
    requireCount(entries.size(), entryCount(order), "symmetricPart");
    std::vector<double> sums(symmetricCount(order), 0.0);
    for (std::size_t entry = 0; entry < entries.size(); ++entry) {
        std::array<int, 3> digits{};
        std::size_t rest = entry;
        for (int i = 0; i < order; ++i, rest /= 3) ++digits[rest % 3];
        sums[symmetricIndex({digits[0], digits[1], digits[2]})] += entries[entry];
    }
    const std::vector<TensorPowers> components = symmetricComponents(order);
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] /= multiplicity(components[i]);
    return sums;
}

double evaluateTensor(int order, std::span<const double> components, const glm::dvec3& x) {
    requireCount(components.size(), symmetricCount(order), "evaluateTensor");
    double sum = 0;
    std::size_t i = 0;
    for (const TensorPowers p : symmetricComponents(order)) {
        sum += multiplicity(p) * components[i++] * power(x.x, p.x) * power(x.y, p.y) * power(x.z, p.z);
    }
    return sum;
}

double fullTrace(int order, std::span<const double> components) {
    requireCount(components.size(), symmetricCount(order), "fullTrace");
    if (order % 2 != 0) return 0;
    double sum = 0;
    for (const TensorPowers half : symmetricComponents(order / 2)) {
        sum += multiplicity(half) * components[symmetricIndex({2 * half.x, 2 * half.y, 2 * half.z})];
    }
    return sum;
}

TensorRotation::TensorRotation(int order, const glm::dmat3& orthogonal) : count_(symmetricCount(order)) {
    const glm::dmat3 rest = glm::transpose(orthogonal) * orthogonal - glm::dmat3(1.0);
    for (int c = 0; c < 3; ++c) {
        for (int r = 0; r < 3; ++r) {
            if (!(std::abs(rest[c][r]) < 1e-9)) {
                throw Error(Code::kInvalidArgument, "TensorRotation: the matrix is not orthogonal (off by " +
                                                        std::to_string(rest[c][r]) + "; at most 1e-9 is)");
            }
        }
    }
    matrix_.assign(count_ * count_, 0.0);
    const std::vector<TensorPowers> components = symmetricComponents(order);
    for (std::size_t from = 0; from < count_; ++from) {
        // g(y) = f(A^T y): each factor x_i of a monomial becomes the linear form (column i of A) . y.
        std::vector<double> polynomial{multiplicity(components[from])};
        int degree = 0;
        const std::array<int, 3> powers{components[from].x, components[from].y, components[from].z};
        for (int axis = 0; axis < 3; ++axis) {
            for (int i = 0; i < powers[static_cast<std::size_t>(axis)]; ++i) {
                polynomial = timesForm(degree++, polynomial, orthogonal[axis]);
            }
        }
        for (std::size_t to = 0; to < count_; ++to) matrix_[to * count_ + from] = polynomial[to] / multiplicity(components[to]);
    }
}

void TensorRotation::apply(std::span<double> components) const {
    requireCount(components.size(), count_, "TensorRotation");
    std::array<double, symmetricCount(kTensorOrderMax)> result{};
    for (std::size_t row = 0; row < count_; ++row) {
        for (std::size_t column = 0; column < count_; ++column) {
            result[row] += matrix_[row * count_ + column] * components[column];
        }
    }
    for (std::size_t i = 0; i < count_; ++i) components[i] = result[i];
}

}  // namespace radiata
