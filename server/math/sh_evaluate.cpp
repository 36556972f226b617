#include "math/sh_evaluate.h"

#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "base/error.h"

namespace radiata {
namespace {

constexpr std::size_t kCountMax = (kLmaxLimit + 1) * (kLmaxLimit + 1);

template <typename Real>
double sum(ShLayout layout, std::span<const Real> coefficients, const glm::dvec3& direction) {
    std::array<double, kCountMax> basis;
    const auto values = std::span(basis).first(layout.count());
    evaluateSh(layout, direction, values);
    double result = 0;
    for (std::size_t i = 0; i < values.size(); ++i) result += values[i] * static_cast<double>(coefficients[i]);
    return result;
}

}  // namespace

void evaluateSh(ShLayout layout, const glm::dvec3& direction, std::span<double> values) {
    if (layout.lmax < 0 || layout.lmax > kLmaxLimit || values.size() != layout.count()) {
        throw Error(Code::kInternal,
                    "evaluateSh: lmax " + std::to_string(layout.lmax) + " with " + std::to_string(values.size()) + " values");
    }
    const double z = direction.z;
    double cosine = 1, sine = 0;                       // Re and Im of (x + i y)^m
    double sectoral = 0.5 * std::numbers::inv_sqrtpi;  // normalised P_m^m / sin^m, without Condon-Shortley phase
    for (int m = 0; m <= layout.lmax; ++m) {
        double before = 0;
        double here = sectoral;
        for (int l = m; l <= layout.lmax; ++l) {
            if (l > m) {
                const double ll = l, mm = m;
                const double a = std::sqrt((2 * ll - 1) * (2 * ll + 1) / ((ll - mm) * (ll + mm)));
                const double b =
                    std::sqrt((2 * ll + 1) * (ll + mm - 1) * (ll - mm - 1) / ((ll - mm) * (ll + mm) * (2 * ll - 3)));
                const double next = a * z * here - b * before;
                before = here;
                here = next;
            }
            if (l % layout.step() != 0) continue;
            if (m == 0) {
                values[layout.index(l, 0)] = here;
            } else {
                // sqrt2 Re Y_l^-m has the two signs (-1)^m cancel; sqrt2 Im Y_l^m keeps the Condon-Shortley one.
                const double sign = m % 2 != 0 ? -1 : 1;
                values[layout.index(l, -m)] = std::numbers::sqrt2 * here * cosine;
                values[layout.index(l, m)] = std::numbers::sqrt2 * here * sine * sign;
            }
        }
        const double turned = cosine * direction.x - sine * direction.y;
        sine = cosine * direction.y + sine * direction.x;
        cosine = turned;
        sectoral *= std::sqrt((2.0 * m + 3) / (2.0 * m + 2));
    }
}

double evaluateSh(ShLayout layout, std::span<const double> coefficients, const glm::dvec3& direction) {
    return sum(layout, coefficients, direction);
}
double evaluateSh(ShLayout layout, std::span<const float> coefficients, const glm::dvec3& direction) {
    return sum(layout, coefficients, direction);
}

}  // namespace radiata
