// Boxes of glyphs as Peters et al. 2023 compute them, and exact ones from all good samples, to see how far the former fall
// short. Source: Peters et al. 2023, Sec. 4.2: k * 256 spherical Fibonacci points in the upper hemisphere, then five Newton
// steps from the best one. The exact ones: Newton's method from every local maximum among the samples that the inequality of M.
// Riesz does not rule out (max <= sample / cos((k + 1) tau)).
#pragma once

#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace radiata::lab {

/// Half extents along x, y and z of the surface of both lobes, in units of amplitude.
struct HalfExtents {
    glm::dvec3 of_samples{0};  ///< best sample alone
    glm::dvec3 of_peters{0};   ///< polished from the best sample, before enlargement
    glm::dvec3 exact{0};
};

class PetersBoxes {
public:
    /// Tabulates the basis, so that it is evaluated once for all glyphs. \param k  even, at least 2
    explicit PetersBoxes(int k);

    /// \param coefficients  of one glyph, even bands up to k \param exact  fills that too, which takes much longer
    HalfExtents box(std::span<const float> coefficients, bool exact) const;

    /// 1.025 for k <= 8, else 1.035.
    double enlargement() const { return k_ <= 8 ? 1.025 : 1.035; }
    std::size_t samples() const { return directions_.size(); }

private:
    int k_;
    double covering_radius_;
    std::vector<glm::dvec3> directions_;
    std::vector<float> basis_;  ///< [function][direction]
};

}  // namespace radiata::lab
