// Between symmetric Cartesian tensors and spherical harmonics: two names of the same functions on the sphere.
// Homogeneous polynomials of degree n restricted to the sphere are exactly the span of bands n, n - 2, n - 4, ..., and both
// have (n + 1) (n + 2) / 2 coefficients, so the map is a square matrix and nothing is lost either way. Source: Hlawitschka et
// al., Sec. 3.1 (the matrix M of scalar products on the sphere).
#pragma once

#include <span>
#include <vector>

#include "math/sh_layout.h"

namespace radiata {

/// A pair of linear maps, built once for an order and applied to many tensors. Immutable, usable from several threads.
class TensorSh {
public:
    /// \param order  2 to 12. \throws Error(kUnsupported) for another
    explicit TensorSh(int order);

    /// Even bands to the order; for odd orders the full layout, whose even bands are then zero.
    ShLayout layout() const { return layout_; }

    /// Both in double, internal convention; |error| < 1e-13 of the largest value, there and back < 1e-12, orders 2 to 12
    /// (tests/unit/math/tensor_sh_test.cpp).
    /// \param components  symmetricCount(order) values; \param coefficients  layout().count() values
    void toSh(std::span<const double> components, std::span<double> coefficients) const;
    /// \throws Error(kInternal) for bands that no tensor of this order has: those of the other parity must be zero
    void toTensor(std::span<const double> coefficients, std::span<double> components) const;

private:
    int order_;
    ShLayout layout_;
    std::vector<std::size_t> used_;          ///< coefficients of the order's parity
    std::vector<double> to_sh_, to_tensor_;  ///< square, row by row
};

}  // namespace radiata
