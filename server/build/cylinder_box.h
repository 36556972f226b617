// Box around van Almsick's bounding cylinder, for comparisons: how much the certified boxes save.
// Source: van Almsick et al. 2011 as Peters et al. 2023, Sec. 5 and Table 1, use it: a cylinder about the z axis that holds the
// glyph, from the sizes of its coefficients alone, and the box around that cylinder.
#pragma once

#include <span>

#include "build/bounds.h"
#include "math/sh_layout.h"

namespace radiata {

/// Radius and half length are sums over l and m of the amplitude of the wave in azimuth times the largest |Y| sin t or |Y cos
/// t| of that l and m.
class CylinderBoxes {
public:
    explicit CylinderBoxes(ShLayout layout);

    /// \param coefficients  layout.count(), internal convention
    /// \param low, high     box in units of amplitude; holds |f(d)| d for all d
    void box(std::span<const float> coefficients, glm::vec3& low, glm::vec3& high) const;

private:
    ShLayout layout_;
    std::vector<double> across_, along_;  ///< by index(l, m), m >= 0
};

}  // namespace radiata
