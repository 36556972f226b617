// Peaks of a function on the sphere: its local maxima above 0, by ascent from many directions.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "math/sh_derivatives.h"
#include "model/pick.h"

namespace radiata {

class PeakFinder {
public:
    /// \param coefficients  layout.count() values in the internal convention, finite
    PeakFinder(ShLayout layout, std::span<const float> coefficients);

    /// All peaks, the largest first; of even layouts one of each pair of ends. Ascents start in directions of which one lies
    /// within kStartSpacing / lmax of every direction, so each peak is found whose basin holds a disc of that radius: those of
    /// two lobes that are seen apart are several times as wide. Directions are exact to 1e-6 degrees unless the peak is flatter
    /// than 1e-6 of the bound of the curvature; such a maximum (a ridge or a sphere) is no peak.
    /// Cost: about 10 ms at band 8, 0.3 s at band 16.
    std::vector<model::Peak> peaks() const;

    /// Which of the peaks the ascent from a direction ends in: the peak of the lobe that the direction belongs to.
    /// Nothing if f is not above 0 there, or if it ends in none of them. \param direction  unit
    std::optional<std::size_t> lobe(const std::vector<model::Peak>& peaks, const glm::dvec3& direction) const;

    static constexpr double kStartSpacing = 0.6;  ///< radians

private:
    std::optional<model::Peak> climb(glm::dvec3 p) const;
    bool same(const glm::dvec3& a, const glm::dvec3& b) const;

    ShLayout layout_;
    ShDerivatives function_;
};

/// Fills in peaks, rank and angle from the coefficients and the direction.
void findPeaks(model::PickedGlyph& glyph);

}  // namespace radiata
