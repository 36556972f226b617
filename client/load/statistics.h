// Figures of a load run: percentiles by nearest rank and Jain's fairness index.
#pragma once

#include <cstddef>
#include <vector>

namespace radiata::client {

/// In the unit of the values; all 0 if there are none.
struct Summary {
    std::size_t count = 0;
    double mean = 0, p50 = 0, p95 = 0, p99 = 0, maximum = 0;
};

/// Percentile p is the smallest value that at least p % of the values do not exceed.
Summary summarise(std::vector<double> values);

/// (sum x)^2 / (n sum x^2): 1 if all are equal, 1/n if one has everything, 1 if nobody has anything.
/// Source: Jain, Chiu, Hawe 1984, DEC Research Report TR-301.
double jainIndex(const std::vector<double>& shares);

}  // namespace radiata::client
