// Fills a batch fibre by fibre, and leaves out fibres with coordinates that nothing can be done with.
#pragma once

#include <span>
#include <string>

#include "model/tractogram.h"

namespace radiata::io {

/// A fibre with more points is a file without separators, not anatomy.
inline constexpr std::uint64_t kFibrePointsMax = std::uint64_t{1} << 26;

inline bool usable(const glm::vec3& p) {
    using model::kCoordinateMaxMm;
    // False for NaN.
    return std::abs(p.x) <= kCoordinateMaxMm && std::abs(p.y) <= kCoordinateMaxMm && std::abs(p.z) <= kCoordinateMaxMm;
}

/// Numbers fibres and points over all batches of one source.
class FibreBuilder {
public:
    /// \param header  outlives the builder
    explicit FibreBuilder(const model::TractogramHeader& header) : header_(header) {}

    /// The batch that fibres go to from now on; emptied.
    void begin(model::FibreBatch& batch);
    void addPoints(std::span<const glm::vec3> points);
    void addPoint(const glm::vec3& point) { addPoints({&point, 1}); }
    /// The fibre that is being filled will be left out, but keeps its number.
    void damage() { damaged_now_ = true; }
    /// \param fibre_values  the fibre's numbers, column after column as the header has them
    /// \throws Error(kResourceExhausted) for one fibre more than can be numbered
    void endFibre(std::span<const float> fibre_values = {});

    /// Points of the fibre that is being filled.
    std::size_t pending() const { return batch_->points.size() - batch_->offsets.back(); }
    std::uint64_t fibres() const { return fibres_; }
    std::uint64_t points() const { return points_; }
    std::uint64_t damagedFibres() const { return damaged_; }

private:
    const model::TractogramHeader& header_;
    model::FibreBatch* batch_ = nullptr;
    std::uint64_t fibres_ = 0, points_ = 0, damaged_ = 0;
    bool damaged_now_ = false;
};

}  // namespace radiata::io
