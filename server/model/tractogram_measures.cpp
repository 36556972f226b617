// Counts, lengths, bounds and the step of fibres, batch by batch.
#include <algorithm>
#include <cmath>

#include "model/tractogram.h"

namespace radiata::model {
namespace {

constexpr double kStepTolerance = 0.01;

}  // namespace

void TractogramMeasures::add(const FibreBatch& batch) {
    fibres += batch.fibreCount();
    points += batch.points.size();
    for (const glm::vec3& p : batch.points) {
        bounds_min = glm::min(bounds_min, p);
        bounds_max = glm::max(bounds_max, p);
    }
    for (std::size_t f = 0; f < batch.fibreCount(); ++f) {
        const std::span<const glm::vec3> fibre = batch.fibre(f);
        if (fibre.empty()) ++empty_fibres;
        longest_fibre_points = std::max<std::uint64_t>(longest_fibre_points, fibre.size());
        double length = 0;
        for (std::size_t i = 1; i < fibre.size(); ++i) {
            const glm::dvec3 d = glm::dvec3(fibre[i]) - glm::dvec3(fibre[i - 1]);
            const double segment = std::sqrt(glm::dot(d, d));
            length += segment;
            if (i + 1 == fibre.size()) continue;
            shortest_segment_mm = std::min(shortest_segment_mm, segment);
            longest_segment_mm = std::max(longest_segment_mm, segment);
            inner_length_mm += segment;
            ++inner_segments;
        }
        if (fibre.size() > 1) segments += fibre.size() - 1;
        length_mm += length;
        longest_fibre_mm = std::max(longest_fibre_mm, length);
    }
}

double TractogramMeasures::constantStepMm() const {
    if (inner_segments == 0) return 0;
    const double mean = inner_length_mm / static_cast<double>(inner_segments);
    // Each end of a segment is off by at most half a unit in the last place along each axis.
    const glm::vec3 largest = glm::max(glm::abs(bounds_min), glm::abs(bounds_max));
    const double rounding = std::sqrt(3.0) * std::max({largest.x, largest.y, largest.z}) * 0x1p-23;
    const double slack = kStepTolerance * mean + rounding;
    return longest_segment_mm - mean <= slack && mean - shortest_segment_mm <= slack ? mean : 0;
}

}  // namespace radiata::model
