#include "reference/volume_function.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "reference/cubic.h"

namespace radiata::reference {
namespace {

/// Uniform B-spline of the given degree, its support centred on 0, by the recursion of Cox and de Boor.
double bSpline(int degree, double x) {
    if (degree == 0) return x >= -0.5 && x < 0.5 ? 1 : 0;
    const double half = 0.5 * (degree + 1);
    return ((half + x) * bSpline(degree - 1, x + 0.5) + (half - x) * bSpline(degree - 1, x - 0.5)) / degree;
}

std::array<double, 8> cornersOf(const model::ScalarImage& image, const glm::ivec3& cell) {
    std::array<double, 8> corners{};
    for (int n = 0; n < 8; ++n) corners[static_cast<std::size_t>(n)] = image.at(cell + glm::ivec3(n & 1, n >> 1 & 1, n >> 2));
    return corners;
}

}  // namespace

glm::ivec3 VolumeFunction::cellOf(const glm::dvec3& p) const {
    return glm::clamp(glm::ivec3(glm::floor(p)), glm::ivec3(0), image_.size - 2);
}

double VolumeFunction::sample(int i, int j, int k) const {
    return image_.at(glm::clamp(glm::ivec3(i, j, k), glm::ivec3(0), image_.size - 1));
}

double VolumeFunction::value(const glm::dvec3& p) const {
    const glm::ivec3 cell = cellOf(p);
    return cellValue(cornersOf(image_, cell), p - glm::dvec3(cell));
}

glm::dvec3 VolumeFunction::gradient(const glm::dvec3& p) const {
    // Along each axis the trilinear function is linear, so its slope is the difference of its ends.
    const glm::ivec3 cell = cellOf(p);
    const std::array<double, 8> corners = cornersOf(image_, cell);
    glm::dvec3 gradient;
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 low = p - glm::dvec3(cell), high = low;
        low[axis] = 0;
        high[axis] = 1;
        gradient[axis] = cellValue(corners, high) - cellValue(corners, low);
    }
    return gradient;
}

double VolumeFunction::splineValue(const glm::dvec3& p) const {
    const glm::ivec3 first(glm::floor(p));
    double sum = 0;
    for (int k = first.z - 2; k <= first.z + 3; ++k) {
        for (int j = first.y - 2; j <= first.y + 3; ++j) {
            for (int i = first.x - 2; i <= first.x + 3; ++i) {
                sum += bSpline(3, p.x - i) * bSpline(3, p.y - j) * bSpline(3, p.z - k) * sample(i, j, k);
            }
        }
    }
    return sum;
}

glm::dvec3 VolumeFunction::splineGradient(const glm::dvec3& p) const {
    // The derivative of a B-spline is the difference of two of the degree below, half a step to either side.
    const glm::ivec3 first(glm::floor(p));
    const auto slope = [](double x) { return bSpline(2, x + 0.5) - bSpline(2, x - 0.5); };
    glm::dvec3 sum(0);
    for (int k = first.z - 2; k <= first.z + 3; ++k) {
        for (int j = first.y - 2; j <= first.y + 3; ++j) {
            for (int i = first.x - 2; i <= first.x + 3; ++i) {
                const glm::dvec3 x = p - glm::dvec3(i, j, k);
                const glm::dvec3 weight(bSpline(3, x.x), bSpline(3, x.y), bSpline(3, x.z));
                sum += sample(i, j, k) * glm::dvec3(slope(x.x) * weight.y * weight.z, weight.x * slope(x.y) * weight.z,
                                                    weight.x * weight.y * slope(x.z));
            }
        }
    }
    return sum;
}

std::optional<VolumeFunction::Hit> VolumeFunction::firstHit(const glm::dvec3& origin, const glm::dvec3& direction,
                                                            double isovalue, double t_min, double t_max) const {
    // Where the ray is within the volume at all, and every parameter at which it crosses a plane of the grid.
    double begin = t_min, end = t_max;
    std::vector<double> crossings;
    for (int axis = 0; axis < 3; ++axis) {
        const double last = image_.size[axis] - 1;
        if (direction[axis] == 0) {
            if (origin[axis] < 0 || origin[axis] > last) return std::nullopt;
            continue;
        }
        const double a = -origin[axis] / direction[axis], b = (last - origin[axis]) / direction[axis];
        begin = std::max(begin, std::min(a, b));
        end = std::min(end, std::max(a, b));
        for (int plane = 0; plane < image_.size[axis]; ++plane) crossings.push_back((plane - origin[axis]) / direction[axis]);
    }
    if (!(begin <= end)) return std::nullopt;
    std::erase_if(crossings, [&](double t) { return t <= begin || t >= end; });
    crossings.push_back(end);
    std::ranges::sort(crossings);
    double from = begin;
    for (const double to : crossings) {
        const glm::ivec3 cell = cellOf(origin + 0.5 * (from + to) * direction);
        const std::array<double, 8> corners = cornersOf(image_, cell);
        if (std::ranges::all_of(corners, [](double corner) { return std::isfinite(corner); })) {
            const auto place = [&](double t) {
                return glm::clamp(origin + t * direction - glm::dvec3(cell), glm::dvec3(0), glm::dvec3(1));
            };
            if (const auto root = firstChordRoot(corners, isovalue, place(from), place(to))) {
                return Hit{from + root->u * (to - from), root->margin};
            }
        }
        from = to;
    }
    return std::nullopt;
}

}  // namespace radiata::reference
