// Values of all real spherical harmonics of a layout along one direction, in double: the plain evaluator that readers and tests
// use. Internal convention (kDescoteaux07, math/sh_convention.h).
#pragma once

#include <span>

#include <glm/glm.hpp>

#include "math/sh_layout.h"

namespace radiata {

/// \param direction  unit
/// \param values     layout.count() values, in the layout's order
/// |error| < 1e-14 times sqrt(2 l + 1) for bands to 16 (tests/unit/math/sh_evaluate_test.cpp)
/// Source: Holmes & Featherstone 2002, Eq. 11 (normalised forward columns), with sin^m theta cos m phi taken as Re (x + i y)^m,
/// so that nothing is divided at the poles.
void evaluateSh(ShLayout layout, const glm::dvec3& direction, std::span<double> values);

/// The function with these coefficients along one direction.
double evaluateSh(ShLayout layout, std::span<const double> coefficients, const glm::dvec3& direction);
double evaluateSh(ShLayout layout, std::span<const float> coefficients, const glm::dvec3& direction);

}  // namespace radiata
