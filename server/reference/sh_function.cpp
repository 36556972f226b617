#include "reference/sh_function.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "base/error.h"

namespace radiata::reference {

ShFunction::ShFunction(ShLayout layout, std::span<const double> coefficients) : layout_(layout) { prepare(coefficients); }

ShFunction::ShFunction(ShLayout layout, std::span<const float> coefficients) : layout_(layout) {
    prepare(std::vector<double>(coefficients.begin(), coefficients.end()));
}

void ShFunction::prepare(std::span<const double> coefficients) {
    if (coefficients.size() != layout_.count()) {
        throw Error(Code::kInternal, "ShFunction: " + std::to_string(coefficients.size()) + " coefficients; lmax " +
                                         std::to_string(layout_.lmax) + " needs " + std::to_string(layout_.count()));
    }
    const int lmax = layout_.lmax;
    // Normalised P_m^m without sin^m, with the Condon-Shortley sign: p_m = -p_(m-1) sqrt((2m + 1) / 2m).
    double p_mm = std::sqrt(1 / (4 * std::numbers::pi));
    for (int m = 0; m <= lmax; ++m) {
        if (m > 0) p_mm *= -std::sqrt((2.0 * m + 1) / (2.0 * m));
        Order order;
        for (int l = m; l <= lmax; ++l) {
            const double l2 = double(l) * l, next2 = (l + 1.0) * (l + 1.0), m2 = double(m) * m;
            order.a.push_back(std::sqrt((4 * next2 - 1) / (next2 - m2)));
            order.b.push_back(l > m ? -order.a.back() * std::sqrt((l2 - m2) / (4 * l2 - 1)) : 0.0);
            const bool stored = layout_.full || l % 2 == 0;
            const double scale = m == 0 ? p_mm : p_mm * std::numbers::sqrt2;
            const double sign = m % 2 == 0 ? 1 : -1;
            order.cosine.push_back(stored ? scale * (m == 0 ? 1 : sign) * coefficients[layout_.index(l, -m)] : 0.0);
            order.sine.push_back(stored && m > 0 ? scale * coefficients[layout_.index(l, m)] : 0.0);
        }
        orders_.push_back(std::move(order));
    }
}

double ShFunction::operator()(const glm::dvec3& direction) const {
    const glm::dvec3 p = glm::normalize(direction);
    double sum = 0;
    double power_re = 1, power_im = 0;  // (x + i y)^m
    for (const Order& order : orders_) {
        double cosine = 0, cosine_next = 0, sine = 0, sine_next = 0;
        for (std::size_t i = order.a.size(); i-- > 0;) {
            const double factor = order.a[i] * p.z;
            const double after = i + 1 < order.b.size() ? order.b[i + 1] : 0.0;
            const double c = order.cosine[i] + factor * cosine + after * cosine_next;
            const double s = order.sine[i] + factor * sine + after * sine_next;
            cosine_next = cosine;
            sine_next = sine;
            cosine = c;
            sine = s;
        }
        sum += power_re * cosine + power_im * sine;
        const double re = power_re * p.x - power_im * p.y;
        power_im = power_re * p.y + power_im * p.x;
        power_re = re;
    }
    return sum;
}

glm::dvec3 ShFunction::gradient(const glm::dvec3& direction) const {
    const glm::dvec3 p = glm::normalize(direction);
    const glm::dvec3 tangents[2] = {anyOrthogonal(p), glm::cross(p, anyOrthogonal(p))};
    // On a great circle f is a trigonometric polynomial T of degree n, for which M. Riesz's formula is exact:
    // T'(0) = 1/(4n) sum_(r=1..2n) (-1)^(r+1) T(x_r) / sin^2(x_r / 2),  x_r = (2r - 1) pi / 2n.
    const int n = std::max(layout_.lmax, 1);
    glm::dvec3 gradient(0);
    for (const glm::dvec3& tangent : tangents) {
        double slope = 0;
        for (int r = 1; r <= 2 * n; ++r) {
            const double x = (2 * r - 1) * std::numbers::pi / (2 * n);
            const double weight = 1 / (4 * n * std::pow(std::sin(x / 2), 2));
            slope += (r % 2 == 1 ? weight : -weight) * (*this)(std::cos(x) * p + std::sin(x) * tangent);
        }
        gradient += slope * tangent;
    }
    return gradient;
}

glm::dvec3 anyOrthogonal(const glm::dvec3& v) {
    const glm::dvec3 size = glm::abs(v);
    const glm::dvec3 axis = size.x <= size.y && size.x <= size.z ? glm::dvec3(1, 0, 0)
                            : size.y <= size.z                   ? glm::dvec3(0, 1, 0)
                                                                 : glm::dvec3(0, 0, 1);
    return glm::normalize(glm::cross(v, axis));
}

}  // namespace radiata::reference
