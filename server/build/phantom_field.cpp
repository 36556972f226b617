#include "build/phantom_field.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace radiata::phantom {
namespace {

constexpr double kCellMm = 6;

struct Nearest {
    double distance_squared = std::numeric_limits<double>::infinity();
    double radius = 0;
    glm::dvec3 tangent{0};
};

/// Keeps the nearer of what it had and the segment from point i of the strand.
void nearer(Nearest& nearest, const Strand& strand, std::size_t i, const glm::dvec3& p) {
    const glm::dvec3 along = strand.points[i + 1] - strand.points[i];
    const double t = std::clamp(glm::dot(p - strand.points[i], along) / glm::dot(along, along), 0.0, 1.0);
    const glm::dvec3 offset = p - (strand.points[i] + t * along);
    const double distance_squared = glm::dot(offset, offset);
    if (distance_squared >= nearest.distance_squared) return;
    nearest = {distance_squared, glm::mix(strand.radii[i], strand.radii[i + 1], t),
               glm::mix(strand.tangents[i], strand.tangents[i + 1], t)};
}

double weight(const Nearest& nearest) {
    const double outward = std::clamp(2 * std::sqrt(nearest.distance_squared) / nearest.radius - 1, 0.0, 1.0);
    return 1 - outward * outward * (3 - 2 * outward);
}

}  // namespace

BundleField::BundleField(std::vector<Bundle> bundles) : bundles_(std::move(bundles)) {
    glm::dvec3 low(std::numeric_limits<double>::infinity()), high = -low;
    for (const Bundle& bundle : bundles_) {
        for (const Strand& strand : bundle.strands) {
            for (std::size_t i = 0; i < strand.points.size(); ++i) {
                low = glm::min(low, strand.points[i] - strand.radii[i]);
                high = glm::max(high, strand.points[i] + strand.radii[i]);
            }
        }
    }
    origin_mm_ = low;
    cells_ = glm::ivec3(glm::floor((high - low) / kCellMm)) + 1;
    segments_.resize(static_cast<std::size_t>(cells_.x) * cells_.y * cells_.z);
    for (std::size_t b = 0; b < bundles_.size(); ++b) {
        for (std::size_t s = 0; s < bundles_[b].strands.size(); ++s) {
            const Strand& strand = bundles_[b].strands[s];
            for (std::size_t i = 0; i + 1 < strand.points.size(); ++i) {
                const double reach = std::max(strand.radii[i], strand.radii[i + 1]);
                const glm::ivec3 first = cellOf(glm::min(strand.points[i], strand.points[i + 1]) - reach);
                const glm::ivec3 last = cellOf(glm::max(strand.points[i], strand.points[i + 1]) + reach);
                for (int z = first.z; z <= last.z; ++z) {
                    for (int y = first.y; y <= last.y; ++y) {
                        for (int x = first.x; x <= last.x; ++x) {
                            segments_[cell({x, y, z})].push_back(
                                {static_cast<std::uint16_t>(b), static_cast<std::uint16_t>(s), static_cast<std::uint16_t>(i)});
                        }
                    }
                }
            }
        }
    }
}

glm::ivec3 BundleField::cellOf(const glm::dvec3& p_world) const {
    return glm::clamp(glm::ivec3(glm::floor((p_world - origin_mm_) / kCellMm)), glm::ivec3(0), cells_ - 1);
}

FieldSample BundleField::sample(const glm::dvec3& p_world) const {
    FieldSample result;
    const glm::dvec3 local = (p_world - origin_mm_) / kCellMm;
    if (glm::any(glm::lessThan(local, glm::dvec3(0))) || glm::any(glm::greaterThanEqual(local, glm::dvec3(cells_))))
        return result;
    const std::vector<Segment>& segments = segments_[cell(cellOf(p_world))];
    for (std::size_t i = 0; i < segments.size();) {
        const std::uint16_t b = segments[i].bundle;
        double strongest = 0;
        glm::dvec3 tangent(0);
        while (i < segments.size() && segments[i].bundle == b) {
            const std::uint16_t s = segments[i].strand;
            Nearest nearest;
            for (; i < segments.size() && segments[i].bundle == b && segments[i].strand == s; ++i) {
                nearer(nearest, bundles_[b].strands[s], segments[i].point, p_world);
            }
            const double w = weight(nearest);
            strongest = std::max(strongest, w);
            tangent += w * glm::normalize(nearest.tangent);
        }
        if (strongest > 0 && glm::length(tangent) > 1e-6 && result.count < kBundlesMax) {
            result.bundles[result.count++] = {bundles_[b].id, bundles_[b].fraction * strongest, glm::normalize(tangent)};
        }
    }
    const double total = std::max(1.0, result.total());
    for (std::size_t i = 0; i < result.count; ++i) result.bundles[i].fraction /= total;
    return result;
}

}  // namespace radiata::phantom
