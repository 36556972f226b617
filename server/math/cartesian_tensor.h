// Cartesian tensors of any order as functions on the sphere: f(x) = T_(i1 i2 ... in) x_i1 x_i2 ... x_in.
// Source: Hlawitschka et al., Reynolds glyphs, Eq. 2, 4 and 5.
// The product x_i1 ... x_in does not change when indices change places, so f, and with it the glyph, depends only on the mean
// of T over all permutations of its indices: its symmetric part, which has (n + 1) (n + 2) / 2 components instead of 3^n.
// Component (a, b, c) of a symmetric tensor is the value of every entry with a indices x, b indices y and c indices z. They are
// ordered by falling a, then by falling b: order 2 is xx, xy, xz, yy, yz, zz.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace radiata {

constexpr int kTensorOrderMin = 2;
constexpr int kTensorOrderMax = 12;

/// How many indices of a component are x, y and z.
struct TensorPowers {
    int x = 0, y = 0, z = 0;
    bool operator==(const TensorPowers&) const = default;
};

/// Components of a symmetric tensor: (order + 1) (order + 2) / 2.
constexpr std::size_t symmetricCount(int order) { return static_cast<std::size_t>((order + 1) * (order + 2) / 2); }
/// Entries of any tensor: 3^order.
constexpr std::size_t entryCount(int order) {
    std::size_t count = 1;
    for (int i = 0; i < order; ++i) count *= 3;
    return count;
}
constexpr std::size_t symmetricIndex(TensorPowers powers) {
    const int below = powers.y + powers.z;
    return static_cast<std::size_t>(below * (below + 1) / 2 + powers.z);
}
/// All components in storage order.
std::vector<TensorPowers> symmetricComponents(int order);
/// How many entries a component stands for: n! / (x! y! z!) (Eq. 5; the paper prints 3n in place of n!). Exact to order 12.
double multiplicity(TensorPowers powers);

/// The symmetric part: component (a, b, c) is the mean of all entries with these powers.
/// \param entries  3^order values, last index fastest (as numpy keeps T[i, j, k, l]); rounding below 1e-15 of the largest entry
std::vector<double> symmetricPart(int order, std::span<const double> entries);

/// f(x) = sum over components of multiplicity * T_abc x^a y^b z^c. \param components  symmetricCount(order) values
double evaluateTensor(int order, std::span<const double> components, const glm::dvec3& x);

/// T_(iijj...) of a symmetric tensor of even order: what its mean over all directions is proportional to. 0 for odd orders.
double fullTrace(int order, std::span<const double> components);

/// A linear change of the directions, built once and applied to many tensors: g(A x) = f(x) for orthogonal A, by writing the
/// linear forms of A^T x into the polynomial; no angle and no spherical harmonic comes into it.
class TensorRotation {
public:
    /// \throws Error(kInvalidArgument) unless `orthogonal` is a rotation or reflection to 1e-9
    TensorRotation(int order, const glm::dmat3& orthogonal);
    /// Replaces the components of f by those of g; |error| < 1e-14 times the norm sqrt(sum multiplicity T^2).
    void apply(std::span<double> components) const;

private:
    std::size_t count_;
    std::vector<double> matrix_;  ///< count x count, row by row
};

}  // namespace radiata
