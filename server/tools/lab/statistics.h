// Quantiles of measured values.
#pragma once

#include <vector>

namespace radiata::lab {

/// Linear between the order statistics; 0 of no values. \param q  0 to 1
double quantile(std::vector<double> values, double q);

inline double median(const std::vector<double>& values) { return quantile(values, 0.5); }

}  // namespace radiata::lab
