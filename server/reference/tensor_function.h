// A symmetric Cartesian tensor as a function of a direction, by contracting all 3^n entries index by index in double. Twin of
// the generated nested polynomials of the shaders: no multiplicities, no monomials. Source: Hlawitschka et al., Eq. 2 and 4.
#pragma once

#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace radiata::reference {

class TensorFunction {
public:
    /// \param components  (order + 1) (order + 2) / 2 values in the order of math/cartesian_tensor.h
    /// \throws Error(kInternal) for another number of them
    TensorFunction(int order, std::span<const double> components);
    TensorFunction(int order, std::span<const float> components);

    /// T_(i1 ... in) x_i1 ... x_in; |error| < 1e-14 times the sum of |entries| |x|^n. Cost: 1.5 * 3^order multiplications.
    double operator()(const glm::dvec3& x) const;
    /// n T_(i1 ... in) x_i2 ... x_in: the gradient in space.
    glm::dvec3 gradient(const glm::dvec3& x) const;

private:
    void expand(std::span<const double> components);

    int order_;
    std::vector<double> entries_;  ///< 3^order, last index fastest
};

}  // namespace radiata::reference
