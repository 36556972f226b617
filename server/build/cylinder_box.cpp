#include "build/cylinder_box.h"

#include <cmath>
#include <numbers>

#include "math/sh_evaluate.h"

namespace radiata {
namespace {

constexpr int kSamples = 2048;

}  // namespace

CylinderBoxes::CylinderBoxes(ShLayout layout) : layout_(layout), across_(layout.count(), 0.0), along_(layout.count(), 0.0) {
    // At azimuth 0 only the cosine waves (m <= 0) differ from 0. No sample is farther than half a step from a maximum of these
    // trigonometric polynomials of degree lmax + 1, so M. Riesz's inequality certifies the sums; the last factor is for
    // rounding to float.
    const double step = std::numbers::pi / kSamples;
    const double margin = (1 + 1e-5) / std::cos((layout.lmax + 1) * step);
    std::vector<double> basis(layout.count());
    for (int i = 0; i <= kSamples; ++i) {
        const double sine = std::sin(i * step), cosine = std::cos(i * step);
        evaluateSh(layout, glm::dvec3(sine, 0, cosine), basis);
        for (int l = 0; l <= layout.lmax; l += layout.step()) {
            for (int m = 0; m <= l; ++m) {
                const double value = margin * std::abs(basis[layout.index(l, -m)]);
                double& across = across_[layout.index(l, m)];
                double& along = along_[layout.index(l, m)];
                across = std::max(across, value * sine);
                along = std::max(along, value * std::abs(cosine));
            }
        }
    }
}

void CylinderBoxes::box(std::span<const float> coefficients, glm::vec3& low, glm::vec3& high) const {
    double radius = 0, half_length = 0;
    for (int l = 0; l <= layout_.lmax; l += layout_.step()) {
        for (int m = 0; m <= l; ++m) {
            const double cosine = coefficients[layout_.index(l, -m)];
            const double amplitude = m == 0 ? std::abs(cosine) : std::hypot(cosine, double{coefficients[layout_.index(l, m)]});
            radius += amplitude * across_[layout_.index(l, m)];
            half_length += amplitude * along_[layout_.index(l, m)];
        }
    }
    high = glm::vec3(glm::dvec3(radius, radius, half_length));
    low = -high;
}

}  // namespace radiata
