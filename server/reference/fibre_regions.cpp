#include "reference/fibre_regions.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace radiata::reference {
namespace {

using Interval = std::pair<double, double>;

std::vector<Interval> clipped(double low, double high) {
    low = std::max(low, 0.0);
    high = std::min(high, 1.0);
    if (low > high) return {};
    return {{low, high}};
}

/// |M (a + t (b - a) - c)|^2 = 1 solved for t.
std::vector<Interval> inEllipsoid(const model::FibreRegion& region, const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dmat3 quadric = glm::inverse(region.axes * glm::transpose(region.axes));
    const glm::dvec3 o = a - region.centre, d = b - a;
    const double qa = glm::dot(d, quadric * d), qb = glm::dot(o, quadric * d), qc = glm::dot(o, quadric * o) - 1;
    if (qa == 0) return qc <= 0 ? std::vector<Interval>{{0, 1}} : std::vector<Interval>{};
    const double root2 = qb * qb - qa * qc;
    if (root2 < 0) return {};
    const double root = std::sqrt(root2);
    return clipped((-qb - root) / qa, (-qb + root) / qa);
}

/// The half spaces of a box, or one alone, cut the interval one after another.
std::vector<Interval> inHalfSpaces(const std::vector<std::pair<glm::dvec3, glm::dvec3>>& point_normals, const glm::dvec3& a,
                                   const glm::dvec3& b) {
    double low = 0, high = 1;
    for (const auto& [point, normal] : point_normals) {
        const double at_a = glm::dot(a - point, normal), at_b = glm::dot(b - point, normal);
        if (at_a > 0 && at_b > 0) return {};
        if (at_a > 0) low = std::max(low, at_a / (at_a - at_b));
        if (at_b > 0) high = std::min(high, at_a / (at_a - at_b));
    }
    return clipped(low, high);
}

std::vector<Interval> inBox(const model::FibreRegion& region, const glm::dvec3& a, const glm::dvec3& b) {
    std::vector<std::pair<glm::dvec3, glm::dvec3>> sides;
    for (int i = 0; i < 3; ++i) {
        glm::dvec3 normal(0);
        normal[i] = 1;
        sides.emplace_back(region.high, normal);
        sides.emplace_back(region.centre, -normal);
    }
    return inHalfSpaces(sides, a, b);
}

bool inMask(const model::FibreRegion& region, const model::ScalarImage& mask, const glm::dvec3& voxel) {
    glm::ivec3 nearest;
    for (int i = 0; i < 3; ++i) {
        nearest[i] = static_cast<int>(std::lround(voxel[i]));
        if (nearest[i] < 0 || nearest[i] >= mask.size[i]) return false;
    }
    return mask.at(nearest) > region.threshold;
}

std::vector<Interval> inVoxels(const model::FibreRegion& region, const model::ScalarImage& mask, const glm::dvec3& a,
                               const glm::dvec3& b) {
    const glm::dmat4 to_voxel = glm::inverse(mask.voxel_to_world);
    const glm::dvec3 va(to_voxel * glm::dvec4(a, 1)), vb(to_voxel * glm::dvec4(b, 1));
    std::vector<double> cuts{0, 1};
    for (int i = 0; i < 3; ++i) {
        const double low = std::min(va[i], vb[i]), high = std::max(va[i], vb[i]);
        for (double plane = std::ceil(low - 0.5) + 0.5; plane < high; ++plane) {
            if (plane > low) cuts.push_back((plane - va[i]) / (vb[i] - va[i]));
        }
    }
    std::sort(cuts.begin(), cuts.end());
    std::vector<Interval> parts;
    for (std::size_t c = 0; c + 1 < cuts.size(); ++c) {
        const double middle = 0.5 * (cuts[c] + cuts[c + 1]);
        if (!inMask(region, mask, va + middle * (vb - va))) continue;
        if (!parts.empty() && parts.back().second == cuts[c]) {
            parts.back().second = cuts[c + 1];
        } else {
            parts.emplace_back(cuts[c], cuts[c + 1]);
        }
    }
    return parts;
}

}  // namespace

std::vector<Interval> insideIntervals(const model::FibreRegion& region, const model::ScalarImage* mask, const glm::dvec3& a,
                                      const glm::dvec3& b) {
    switch (region.shape) {
        case model::RegionShape::kEllipsoid:
            return inEllipsoid(region, a, b);
        case model::RegionShape::kBox:
            return inBox(region, a, b);
        case model::RegionShape::kHalfSpace:
            return inHalfSpaces({{region.centre, region.high}}, a, b);
        case model::RegionShape::kMesh:
            throw std::invalid_argument("regions by meshes are answered point by point: reference/winding_number.h");
        case model::RegionShape::kMask:
            break;
    }
    return inVoxels(region, *mask, a, b);
}

FibreInRegion fibreInRegion(const model::FibreRegion& region, const model::ScalarImage* mask,
                            std::span<const glm::dvec3> points) {
    FibreInRegion found;
    if (points.empty()) return found;
    for (std::size_t i = 0; i < std::max<std::size_t>(points.size(), 2) - 1; ++i) {
        const glm::dvec3 &a = points[i], &b = points[std::min(i + 1, points.size() - 1)];
        const std::vector<Interval> inside = insideIntervals(region, mask, a, b);
        double length = 0;
        for (const Interval& part : inside) length += part.second - part.first;
        found.meets = found.meets || !inside.empty();
        found.leaves = found.leaves || length < 1 - 1e-12;
        if (i == 0) found.first_end = !inside.empty() && inside.front().first == 0;
        found.last_end = !inside.empty() && inside.back().second == 1;
    }
    return found;
}

}  // namespace radiata::reference
