// The Gauss-Legendre rule, from which integrals over the sphere are made.
#pragma once

#include <utility>
#include <vector>

namespace radiata {

/// Nodes and weights on [-1, 1], exact for polynomials to degree 2 n - 1. \param n  at least 1
std::vector<std::pair<double, double>> gaussLegendre(int n);

}  // namespace radiata
