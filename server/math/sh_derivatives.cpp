#include "math/sh_derivatives.h"

#include <cmath>
#include <numbers>
#include <string>

#include "base/error.h"

namespace radiata {
namespace {

/// A_m or B_m with its first two derivatives.
struct Jet {
    double value = 0, first = 0, second = 0;
    void add(double coefficient, const Jet& q) {
        value += coefficient * q.value;
        first += coefficient * q.first;
        second += coefficient * q.second;
    }
};

glm::dvec3 orthogonalTo(const glm::dvec3& p) {
    const glm::dvec3 axis = std::abs(p.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    return glm::normalize(axis - glm::dot(axis, p) * p);
}

}  // namespace

ShDerivatives::ShDerivatives(ShLayout layout, std::span<const double> coefficients) {
    if (coefficients.size() != layout.count()) {
        throw Error(Code::kInternal, "ShDerivatives: " + std::to_string(coefficients.size()) + " coefficients; lmax " +
                                         std::to_string(layout.lmax) + " needs " + std::to_string(layout.count()));
    }
    double sectoral = 0.5 * std::numbers::inv_sqrtpi;
    for (int m = 0; m <= layout.lmax; ++m) {
        std::vector<Term>& terms = orders_.emplace_back();
        const double scale = sectoral * (m == 0 ? 1 : std::numbers::sqrt2);
        const double sign = m % 2 != 0 ? -1 : 1;
        for (int l = m; l <= layout.lmax; ++l) {
            Term term{0, 0, 0, 0};
            const double ll = l, mm = m;
            if (l > m) {
                term.a = std::sqrt((2 * ll - 1) * (2 * ll + 1) / ((ll - mm) * (ll + mm)));
                term.b = std::sqrt((2 * ll + 1) * (ll + mm - 1) * (ll - mm - 1) / ((ll - mm) * (ll + mm) * (2 * ll - 3)));
            }
            if (l % layout.step() == 0) {
                term.cosine = scale * coefficients[layout.index(l, -m)];
                if (m > 0) term.sine = scale * sign * coefficients[layout.index(l, m)];
            }
            terms.push_back(term);
        }
        sectoral *= std::sqrt((2.0 * m + 3) / (2.0 * m + 2));
    }
    for (int l = 0; l <= layout.lmax; l += layout.step()) {
        double squares = 0;
        for (int m = -l; m <= l; ++m) squares += std::pow(coefficients[layout.index(l, m)], 2);
        // |f_l| <= |c_l| sqrt((2l + 1) / 4 pi) by the addition theorem, |f_l''| <= l^2 max |f_l| by Bernstein.
        curvature_bound_ += l * l * std::sqrt(squares * (2 * l + 1) / (4 * std::numbers::pi));
    }
}

SphereDerivatives ShDerivatives::operator()(const glm::dvec3& p) const {
    double f = 0;
    glm::dvec3 g(0);
    double xx = 0, xy = 0, xz = 0, yz = 0, zz = 0;  // hess F; yy = -xx, as powers of x + i y are harmonic
    double re[3] = {1, 0, 0}, im[3] = {0, 0, 0};    // (x + i y)^m, ^(m-1), ^(m-2)
    for (std::size_t order = 0; order < orders_.size(); ++order) {
        Jet a, b, before, q{1, 0, 0};
        for (std::size_t i = 0; i < orders_[order].size(); ++i) {
            const Term& t = orders_[order][i];
            if (i > 0) {
                const Jet next{t.a * p.z * q.value - t.b * before.value, t.a * (q.value + p.z * q.first) - t.b * before.first,
                               t.a * (2 * q.first + p.z * q.second) - t.b * before.second};
                before = q;
                q = next;
            }
            a.add(t.cosine, q);
            b.add(t.sine, q);
        }
        const auto m = static_cast<double>(order);
        f += re[0] * a.value + im[0] * b.value;
        g += glm::dvec3(m * (re[1] * a.value + im[1] * b.value), m * (re[1] * b.value - im[1] * a.value),
                        re[0] * a.first + im[0] * b.first);
        xx += m * (m - 1) * (re[2] * a.value + im[2] * b.value);
        xy += m * (m - 1) * (re[2] * b.value - im[2] * a.value);
        xz += m * (re[1] * a.first + im[1] * b.first);
        yz += m * (re[1] * b.first - im[1] * a.first);
        zz += re[0] * a.second + im[0] * b.second;
        for (int i = 2; i > 0; --i) re[i] = re[i - 1], im[i] = im[i - 1];
        const double turned = re[0] * p.x - im[0] * p.y;
        im[0] = re[0] * p.y + im[0] * p.x;
        re[0] = turned;
    }
    SphereDerivatives result;
    result.value = f;
    result.tangent[0] = orthogonalTo(p);
    result.tangent[1] = glm::cross(p, result.tangent[0]);
    const glm::dmat3 hess(xx, xy, xz, xy, -xx, yz, xz, yz, zz);
    for (int i = 0; i < 2; ++i) {
        result.slope[i] = glm::dot(g, result.tangent[i]);
        for (int j = 0; j < 2; ++j) {
            result.curvature[i][j] = glm::dot(result.tangent[i], hess * result.tangent[j]) - (i == j ? glm::dot(g, p) : 0.0);
        }
    }
    return result;
}

}  // namespace radiata
