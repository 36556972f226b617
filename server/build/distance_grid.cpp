// Squared distances to the cells that the region meets, axis by axis: the lower envelope of parabolas.
// Source: Felzenszwalb and Huttenlocher 2012, Distance transforms of sampled functions, Sec. 2.
#include "build/distance_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/parallel.h"

namespace radiata {
namespace {

constexpr double kFar = 1e30;

std::size_t indexOf(const glm::ivec3& at, const glm::ivec3& size) {
    return static_cast<std::size_t>(at.x) +
           static_cast<std::size_t>(size.x) *
               (static_cast<std::size_t>(at.y) + static_cast<std::size_t>(size.y) * static_cast<std::size_t>(at.z));
}

/// Least of f[q] + (p - q)^2 over q, for each p; in units of steps.
void transformLine(std::vector<double>& f, std::vector<double>& out, std::vector<int>& places, std::vector<double>& bounds) {
    const int n = static_cast<int>(f.size());
    const auto at = [](int i) { return static_cast<std::size_t>(i); };
    int last = 0;
    places[0] = 0;
    bounds[0] = -kFar;
    bounds[1] = kFar;
    for (int q = 1; q < n; ++q) {
        double crossing = 0;
        for (;; --last) {
            const int v = places[at(last)];
            crossing = ((f[at(q)] + q * q) - (f[at(v)] + v * v)) / (2.0 * (q - v));
            if (last == 0 || crossing > bounds[at(last)]) break;
        }
        if (crossing <= bounds[at(last)]) {
            places[0] = q;
            bounds[1] = kFar;
            last = 0;
            continue;
        }
        places[at(++last)] = q;
        bounds[at(last)] = crossing;
        bounds[at(last) + 1] = kFar;
    }
    int k = 0;
    for (int p = 0; p < n; ++p) {
        while (bounds[at(k) + 1] < p) ++k;
        const double way = p - places[at(k)];
        out[at(p)] = f[at(places[at(k)])] + way * way;
    }
    f.swap(out);
}

void transformAxis(std::vector<double>& squares, const glm::ivec3& size, int axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    parallelFor(static_cast<std::size_t>(size[v]), 1, [&](std::size_t begin, std::size_t end) {
        const auto n = static_cast<std::size_t>(size[axis]);
        std::vector<double> line(n), out(n), bounds(n + 1);
        std::vector<int> places(n);
        for (auto j = static_cast<int>(begin); j < static_cast<int>(end); ++j) {
            for (int i = 0; i < size[u]; ++i) {
                glm::ivec3 at(0);
                at[u] = i;
                at[v] = j;
                for (at[axis] = 0; at[axis] < size[axis]; ++at[axis])
                    line[static_cast<std::size_t>(at[axis])] = squares[indexOf(at, size)];
                transformLine(line, out, places, bounds);
                for (at[axis] = 0; at[axis] < size[axis]; ++at[axis])
                    squares[indexOf(at, size)] = line[static_cast<std::size_t>(at[axis])];
            }
        }
    });
}

/// Distances over a box; all kFar if the region is not in it.
DistanceGrid measured(const RegionVolume& region, const glm::dvec3& low, const glm::dvec3& high, int nodes_max) {
    DistanceGrid grid;
    const glm::dvec3 extent = high - low;
    grid.origin_mm = low;
    grid.step_mm = std::max({extent.x, extent.y, extent.z, 1e-3}) / (nodes_max - 1);
    grid.size = glm::max(glm::ivec3(glm::ceil(extent / grid.step_mm)) + 1, glm::ivec3(2));
    std::vector<double> squares(indexOf(grid.size - 1, grid.size) + 1, kFar);
    parallelFor(static_cast<std::size_t>(grid.size.z), 1, [&](std::size_t begin, std::size_t end) {
        for (auto z = static_cast<int>(begin); z < static_cast<int>(end); ++z) {
            for (int y = 0; y < grid.size.y; ++y) {
                for (int x = 0; x < grid.size.x; ++x) {
                    const glm::dvec3 node = grid.origin_mm + grid.step_mm * glm::dvec3(x, y, z);
                    const double half = 0.5 * grid.step_mm;
                    if (region.relate(node - half, node + half) != BoxRelation::kOutside)
                        squares[indexOf({x, y, z}, grid.size)] = 0;
                }
            }
        }
    });
    for (int axis = 0; axis < 3; ++axis) transformAxis(squares, grid.size, axis);
    grid.mm.resize(squares.size());
    std::ranges::transform(squares, grid.mm.begin(), [&](double square) {
        return static_cast<float>(square < kFar / 2 ? std::sqrt(square) * grid.step_mm : kFar);
    });
    return grid;
}

}  // namespace

DistanceGrid distanceGrid(const RegionVolume& region, const glm::dvec3& low, const glm::dvec3& high, int nodes_max) {
    const double extent = std::max(glm::length(high - low), 1.0);
    DistanceGrid grid = measured(region, low, high, nodes_max);
    // What is nearest may lie outside of the box: within the distances found it must have been looked for.
    for (double margin = extent; grid.mm[0] > 1e29F; margin *= 2) {
        if (margin > 16 * extent) {
            throw Error(Code::kInvalidArgument, "the region that colours by distance is more than " +
                                                    std::to_string(std::lround(16 * extent)) + " mm away from the tractogram");
        }
        grid = measured(region, low - margin, high + margin, nodes_max);
    }
    const double farthest = static_cast<double>(*std::ranges::max_element(grid.mm));
    const double margin = std::min(farthest, 2 * extent);
    if (margin > grid.step_mm) return measured(region, low - margin, high + margin, nodes_max);
    return grid;
}

}  // namespace radiata
