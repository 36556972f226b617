// The response of one fibre direction: a lobe on the sphere, symmetric about its axis, as sharp as its bands allow.
// Kernel: the heat kernel of the sphere, of weight exp(-l (l + 1) t) in band l, with t such that the last band gets 0.08. It is
// the spherical Gaussian, so it has no ringing beyond what cutting the series there leaves (below 2 % of the peak), and it
// plays the part that the apodised delta function has in constrained spherical deconvolution (Tournier et al. 2007).
#pragma once

#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "math/sh_layout.h"

namespace radiata::phantom {

class Lobe {
public:
    explicit Lobe(ShLayout layout);

    ShLayout layout() const { return layout_; }
    /// Weight of band l; 1 for l = 0, so that the integral over the sphere is the fraction.
    double weight(int l) const { return weights_[static_cast<std::size_t>(l)]; }
    /// Adds fraction times the lobe about an axis (unit). By the addition theorem its coefficients are weight(l) Y_lm(axis).
    /// \param coefficients  layout.count() values, internal convention
    /// \param basis         layout.count() values of work space
    void add(const glm::dvec3& axis, double fraction, std::span<double> coefficients, std::span<double> basis) const;

private:
    ShLayout layout_;
    std::vector<double> weights_;  // per band
};

}  // namespace radiata::phantom
