#include "tools/lab/float_polynomial.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "math/sh_evaluate.h"

namespace radiata::lab {
namespace {

using Polynomial = std::vector<float>;  // ascending powers

float valueAt(const Polynomial& p, float x) {
    float sum = 0;
    for (std::size_t i = p.size(); i-- > 0;) sum = sum * x + p[i];
    return sum;
}

Polynomial derivativeOf(const Polynomial& p) {
    Polynomial d;
    for (std::size_t i = 1; i < p.size(); ++i) d.push_back(static_cast<float>(i) * p[i]);
    return d;
}

Polynomial product(const Polynomial& a, const Polynomial& b) {
    Polynomial c(a.size() + b.size() - 1, 0.0F);
    for (std::size_t i = 0; i < a.size(); ++i) {
        for (std::size_t j = 0; j < b.size(); ++j) c[i + j] += a[i] * b[j];
    }
    return c;
}

/// Newton's method kept inside a shrinking bracket (Yuksel 2022); stops when the bracket cannot shrink.
float rootBetween(const Polynomial& p, const Polynomial& d, float low, float high) {
    const bool rising = valueAt(p, low) < valueAt(p, high);
    float x = 0.5F * (low + high);
    for (int i = 0; i < 90; ++i) {
        const float value = valueAt(p, x);
        ((value < 0) == rising ? low : high) = x;
        const float middle = 0.5F * (low + high);
        if (middle <= low || middle >= high) break;
        const float next = x - value / valueAt(d, x);
        x = next > low && next < high ? next : middle;
    }
    return x;
}

/// All roots in [low, high] where the sign changes, ascending, by the roots of the derivatives.
std::vector<float> rootsOf(const Polynomial& p, float low, float high) {
    if (p.size() < 2) return {};
    const Polynomial d = derivativeOf(p);
    std::vector<float> ends = rootsOf(d, low, high);
    ends.insert(ends.begin(), low);
    ends.push_back(high);
    std::vector<float> roots;
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
        if ((valueAt(p, ends[i]) < 0) != (valueAt(p, ends[i + 1]) < 0))
            roots.push_back(rootBetween(p, d, ends[i], ends[i + 1]));
    }
    return roots;
}

/// In double, as it depends on k only and would be a constant. \return rows of the inverse of V_(l i) = u_l^i v_l^(k - i)
std::vector<std::vector<float>> inverseVandermonde(int k) {
    const int n = k + 1;
    std::vector<std::vector<double>> a(static_cast<std::size_t>(n), std::vector<double>(static_cast<std::size_t>(2 * n), 0.0));
    for (int l = 0; l < n; ++l) {
        const double angle = l * std::numbers::pi / n;
        for (int i = 0; i < n; ++i) a[l][i] = std::pow(std::cos(angle), i) * std::pow(std::sin(angle), k - i);
        a[l][n + l] = 1;
    }
    for (int column = 0; column < n; ++column) {
        int pivot = column;
        for (int row = column; row < n; ++row) {
            if (std::abs(a[row][column]) > std::abs(a[pivot][column])) pivot = row;
        }
        std::swap(a[column], a[pivot]);
        const double scale = 1 / a[column][column];
        for (double& value : a[column]) value *= scale;
        for (int row = 0; row < n; ++row) {
            if (row == column) continue;
            const double factor = a[row][column];
            for (int c = 0; c < 2 * n; ++c) a[row][c] -= factor * a[column][c];
        }
    }
    std::vector<std::vector<float>> inverse(static_cast<std::size_t>(n));
    for (int row = 0; row < n; ++row) inverse[row].assign(a[row].begin() + n, a[row].end());
    return inverse;
}

}  // namespace

FloatPolynomial::FloatPolynomial(int k, std::vector<float> coefficients)
    : k_(k), coefficients_(std::move(coefficients)), inverse_vandermonde_(inverseVandermonde(k)) {}

Polynomial FloatPolynomial::planePolynomial(const glm::vec3& e, const glm::vec3& direction) const {
    std::vector<float> samples;
    for (int l = 0; l <= k_; ++l) {
        const double angle = l * std::numbers::pi / (k_ + 1);
        const glm::vec3 at = static_cast<float>(std::cos(angle)) * direction + static_cast<float>(std::sin(angle)) * e;
        samples.push_back(static_cast<float>(evaluateSh({k_, false}, coefficients_, glm::normalize(glm::dvec3(at)))));
    }
    Polynomial g;
    for (const auto& row : inverse_vandermonde_) {
        float sum = 0;
        for (std::size_t l = 0; l < samples.size(); ++l) sum += row[l] * samples[l];
        g.push_back(sum);
    }
    return g;
}

float FloatPolynomial::firstHit(const glm::vec3& origin, const glm::vec3& direction, RayCoordinate coordinate) const {
    constexpr float kNone = std::numeric_limits<float>::infinity();
    const float along = glm::dot(origin, direction);
    const glm::vec3 foot = origin - along * direction;
    const float h = glm::length(foot);
    if (!(h > 0)) return kNone;
    Polynomial g = planePolynomial(foot / h, direction);
    float g_max = 0;
    for (int i = 0; i <= k_; ++i) {
        const auto power = [](int n) { return n == 0 ? 1.0 : std::pow(n, n); };
        g_max += std::abs(g[static_cast<std::size_t>(i)]) * static_cast<float>(std::sqrt(power(i) * power(k_ - i) / power(k_)));
    }
    if (g_max < h) return kNone;
    const float u_max = std::sqrt(g_max * g_max / (h * h) - 1);
    Polynomial norm, f;
    float scale = 1, shift = 0, low = -u_max, high = u_max;
    if (coordinate == RayCoordinate::kTurnedFrame) {
        norm = {1, 0, 1};
        scale = h;
        shift = along;
    } else {
        // x = (t + along) / h: the same polynomial in powers of t, and |p|^2 = t^2 + 2 along t + |o|^2.
        Polynomial x{along / h, 1 / h}, sum{0}, power{1};
        for (const float c : g) {
            sum.resize(std::max(sum.size(), power.size()), 0.0F);
            for (std::size_t i = 0; i < power.size(); ++i) sum[i] += c * power[i];
            power = product(power, x);
        }
        g = sum;
        norm = {glm::dot(origin, origin) / (h * h), 2 * along / (h * h), 1 / (h * h)};
        low = -u_max * h - along;
        high = u_max * h - along;
    }
    f = product(g, g);
    Polynomial rest{1};
    for (int i = 0; i <= k_; ++i) rest = product(rest, norm);
    f.resize(std::max(f.size(), rest.size()), 0.0F);
    for (std::size_t i = 0; i < rest.size(); ++i) f[i] -= h * h * rest[i];
    for (const float root : rootsOf(f, low, high)) {
        const float t = root * scale - shift;
        if (t >= 0) return t;
    }
    return kNone;
}

}  // namespace radiata::lab
