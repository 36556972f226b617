#include <algorithm>
#include <limits>
#include <numeric>

#include "tools/lab/plot.h"

namespace radiata::lab {

std::vector<std::size_t> paretoFront(const std::vector<PlotPoint>& points) {
    std::vector<std::size_t> order(points.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&points](std::size_t a, std::size_t b) {
        return points[a].x != points[b].x ? points[a].x < points[b].x : points[a].y < points[b].y;
    });
    std::vector<std::size_t> front;
    double lowest = std::numeric_limits<double>::infinity();
    for (const std::size_t i : order) {
        if (!(points[i].y < lowest)) continue;
        lowest = points[i].y;
        front.push_back(i);
    }
    return front;
}

}  // namespace radiata::lab
