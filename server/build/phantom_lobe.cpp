#include "build/phantom_lobe.h"

#include <cmath>

#include "math/sh_evaluate.h"

namespace radiata::phantom {
namespace {

constexpr double kLastBandWeight = 0.08;

}  // namespace

Lobe::Lobe(ShLayout layout) : layout_(layout) {
    for (int l = 0; l <= layout.lmax; ++l) {
        weights_.push_back(l == 0 ? 1.0 : std::pow(kLastBandWeight, l * (l + 1.0) / (layout.lmax * (layout.lmax + 1.0))));
    }
}

void Lobe::add(const glm::dvec3& axis, double fraction, std::span<double> coefficients, std::span<double> basis) const {
    evaluateSh(layout_, axis, basis);
    for (int l = 0; l <= layout_.lmax; l += layout_.step()) {
        for (int m = -l; m <= l; ++m) {
            const std::size_t j = layout_.index(l, m);
            coefficients[j] += fraction * weight(l) * basis[j];
        }
    }
}

}  // namespace radiata::phantom
