#include "tools/lab/peters_box.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "math/sh_evaluate.h"

namespace radiata::lab {
namespace {

/// f and its first and second derivatives by p[u] and p[v], p[axis] fixed, of f(p / |p|); from nine values of f.
struct Stencil {
    double f, du, dv, duu, duv, dvv;

    template <typename Function>
    Stencil(const Function& value, const glm::dvec3& p, int u, int v) {
        constexpr double h = 1e-3;  // second derivatives are good to about 1e-6 of f, what Newton's method needs of them
        double at[3][3];
        for (int i = -1; i <= 1; ++i) {
            for (int j = -1; j <= 1; ++j) {
                glm::dvec3 q = p;
                q[u] += i * h;
                q[v] += j * h;
                at[i + 1][j + 1] = value(glm::normalize(q));
            }
        }
        f = at[1][1];
        du = (at[2][1] - at[0][1]) / (2 * h);
        dv = (at[1][2] - at[1][0]) / (2 * h);
        duu = (at[2][1] - 2 * f + at[0][1]) / (h * h);
        dvv = (at[1][2] - 2 * f + at[1][0]) / (h * h);
        duv = (at[2][2] - at[2][0] - at[0][2] + at[0][0]) / (4 * h * h);
    }
};

/// Newton's method for the paper's homogenised normal n = f p / |p| - |p| grad f, whose coordinates u and v vanish where the
/// box touches the surface. \return the largest half extent met
template <typename Function>
double polished(const Function& value, glm::dvec3 p, int axis, int steps) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    double best = 0;
    for (int i = 0;; ++i) {
        p = glm::normalize(p);
        const Stencil s(value, p, u, v);
        best = std::max(best, std::abs(s.f * p[axis]));
        if (i == steps) break;
        const double nu = s.f * p[u] - s.du, nv = s.f * p[v] - s.dv;
        const double uu = s.f * (1 - p[u] * p[u]) - s.duu, vv = s.f * (1 - p[v] * p[v]) - s.dvv;
        const double uv = s.dv * p[u] - s.f * p[u] * p[v] - p[v] * s.du - s.duv;
        const double vu = s.du * p[v] - s.f * p[u] * p[v] - p[u] * s.dv - s.duv;
        const double determinant = uu * vv - uv * vu;
        if (determinant == 0) break;
        p[u] -= (vv * nu - uv * nv) / determinant;
        p[v] -= (uu * nv - vu * nu) / determinant;
        if (!std::isfinite(p[u]) || !std::isfinite(p[v]) || glm::length(p) > 1e6 * std::abs(p[axis])) break;
    }
    return best;
}

}  // namespace

PetersBoxes::PetersBoxes(int k) : k_(k), directions_(static_cast<std::size_t>(256 * k)) {
    const double n = static_cast<double>(directions_.size());
    // On the hemisphere an antipode is as near; 0.80 sqrt(area per point) was the largest radius found for these lattices.
    covering_radius_ = 0.85 * std::sqrt(2 * std::numbers::pi / n);
    const ShLayout layout{k, false};
    const std::size_t count = layout.count();
    basis_.resize(count * directions_.size());
    std::vector<double> values(count);
    for (std::size_t i = 0; i < directions_.size(); ++i) {
        const double z = 1 - (2 * static_cast<double>(i) + 1) / (2 * n);
        const double turn = 4 * std::numbers::pi * static_cast<double>(i) / (std::sqrt(5.0) + 1);
        directions_[i] = {std::sqrt(1 - z * z) * std::cos(turn), std::sqrt(1 - z * z) * std::sin(turn), z};
        evaluateSh(layout, directions_[i], values);
        for (std::size_t j = 0; j < count; ++j) basis_[j * directions_.size() + i] = static_cast<float>(values[j]);
    }
}

HalfExtents PetersBoxes::box(std::span<const float> coefficients, bool exact) const {
    const std::size_t n = directions_.size();
    std::vector<float> values(n, 0.0F);
    for (std::size_t j = 0; j < coefficients.size(); ++j) {
        const float c = coefficients[j];
        const float* basis = basis_.data() + j * n;
        for (std::size_t i = 0; i < n; ++i) values[i] += c * basis[i];
    }
    const ShLayout layout{k_, false};
    const auto f = [&](const glm::dvec3& direction) { return evaluateSh(layout, coefficients, direction); };
    HalfExtents box;
    for (int axis = 0; axis < 3; ++axis) {
        const auto extent = [&](std::size_t i) { return std::abs(static_cast<double>(values[i]) * directions_[i][axis]); };
        std::size_t best = 0;
        for (std::size_t i = 1; i < n; ++i) {
            if (extent(i) > extent(best)) best = i;
        }
        box.of_samples[axis] = std::abs(f(directions_[best]) * directions_[best][axis]);
        box.of_peters[axis] = std::max(box.of_samples[axis], polished(f, directions_[best], axis, 5));
        box.exact[axis] = box.of_peters[axis];
        if (!exact) continue;
        const double worth = extent(best) * std::cos((k_ + 1) * covering_radius_) - 1e-6 * extent(best);
        std::vector<std::size_t> good;
        for (std::size_t i = 0; i < n; ++i) {
            if (extent(i) >= worth) good.push_back(i);
        }
        std::sort(good.begin(), good.end(), [&](std::size_t a, std::size_t b) { return extent(a) > extent(b); });
        std::vector<std::size_t> starts;  // local maxima: no start within 2 tau
        for (const std::size_t i : good) {
            const bool near = std::any_of(starts.begin(), starts.end(), [&](std::size_t other) {
                return std::abs(glm::dot(directions_[i], directions_[other])) > std::cos(1.2 * covering_radius_);
            });
            if (near) continue;
            starts.push_back(i);
            box.exact[axis] = std::max(box.exact[axis], polished(f, directions_[i], axis, 8));
        }
    }
    return box;
}

}  // namespace radiata::lab
