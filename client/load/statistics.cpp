#include "load/statistics.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace radiata::client {
namespace {

double nearestRank(const std::vector<double>& sorted, double percent) {
    const double rank = std::ceil(percent / 100 * static_cast<double>(sorted.size()));
    return sorted[static_cast<std::size_t>(std::max(rank, 1.0)) - 1];
}

}  // namespace

Summary summarise(std::vector<double> values) {
    if (values.empty()) return {};
    std::sort(values.begin(), values.end());
    Summary summary;
    summary.count = values.size();
    summary.mean = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
    summary.p50 = nearestRank(values, 50);
    summary.p95 = nearestRank(values, 95);
    summary.p99 = nearestRank(values, 99);
    summary.maximum = values.back();
    return summary;
}

double jainIndex(const std::vector<double>& shares) {
    double sum = 0;
    double squares = 0;
    for (const double share : shares) {
        sum += share;
        squares += share * share;
    }
    return squares > 0 ? sum * sum / (static_cast<double>(shares.size()) * squares) : 1;
}

}  // namespace radiata::client
