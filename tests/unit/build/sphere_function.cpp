#include "unit/build/sphere_function.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace radiata::testing {
namespace {

double factorial(int n) { return std::tgamma(n + 1.0); }

double dot(std::span<const float> c, const double* y) {
    double sum = 0;
    for (std::size_t j = 0; j < c.size(); ++j) sum += static_cast<double>(c[j]) * y[j];
    return sum;
}

}  // namespace

std::vector<double> basisAt(ShLayout layout, const glm::dvec3& d) {
    std::vector<double> out(layout.count());
    double re = 1, im = 0;
    for (int m = 0; m <= layout.lmax; ++m) {
        double before = 0, q = 1;  // q = P_l^m / sin^m theta without Condon-Shortley phase
        for (int odd = 1; odd <= 2 * m - 1; odd += 2) q *= odd;
        for (int l = m; l <= layout.lmax; ++l) {
            if (l > m) {
                const double next = ((2 * l - 1) * d.z * q - (l + m - 1) * before) / (l - m);
                before = q;
                q = next;
            }
            if (l % layout.step() != 0) continue;
            const double norm = std::sqrt((2 * l + 1) / (4 * std::numbers::pi) * factorial(l - m) / factorial(l + m));
            if (m == 0) {
                out[layout.index(l, 0)] = norm * q;
            } else {
                out[layout.index(l, -m)] = std::sqrt(2.0) * norm * q * re;
                out[layout.index(l, m)] = std::sqrt(2.0) * norm * q * im * (m % 2 == 1 ? -1 : 1);
            }
        }
        const double old = re;
        re = re * d.x - im * d.y;
        im = old * d.y + im * d.x;
    }
    return out;
}

std::vector<glm::dvec3> fibonacciDirections(std::size_t count) {
    std::vector<glm::dvec3> directions(count);
    const double turn = std::numbers::pi * (3 - std::sqrt(5.0));
    for (std::size_t i = 0; i < count; ++i) {
        const double z = 1 - (2.0 * static_cast<double>(i) + 1) / static_cast<double>(count);
        const double r = std::sqrt(1 - z * z);
        const double angle = turn * static_cast<double>(i);
        directions[i] = {r * std::cos(angle), r * std::sin(angle), z};
    }
    return directions;
}

double climb(const std::function<double(const glm::dvec3&)>& f, const glm::dvec3& start, double step, glm::dvec3* where) {
    glm::dvec3 d = start;
    double best = f(d);
    while (step > 1e-7) {
        const glm::dvec3 u = glm::normalize(glm::cross(d, std::abs(d.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
        const glm::dvec3 v = glm::cross(d, u);
        bool moved = false;
        for (const glm::dvec3& offset : {u, -u, v, -v}) {
            const glm::dvec3 candidate = glm::normalize(d + step * offset);
            const double value = f(candidate);
            if (value > best) {
                best = value;
                d = candidate;
                moved = true;
                break;
            }
        }
        if (!moved) step *= 0.5;
    }
    if (where != nullptr) *where = d;
    return best;
}

Maximiser::Maximiser(ShLayout layout, std::size_t samples) : layout_(layout), directions_(fibonacciDirections(samples)) {
    basis_.reserve(samples * layout.count());
    for (const glm::dvec3& d : directions_) {
        const std::vector<double> y = basisAt(layout, d);
        basis_.insert(basis_.end(), y.begin(), y.end());
    }
}

TrueExtents Maximiser::extents(std::span<const float> coefficients, bool negative_lobes) const {
    const auto visible = [&](double f) { return negative_lobes ? std::abs(f) : std::max(f, 0.0); };
    std::vector<double> values(directions_.size());
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = dot(coefficients, basis_.data() + i * layout_.count());
    const auto maximise = [&](const std::function<double(const glm::dvec3&, double)>& objective) {
        std::vector<std::pair<double, std::size_t>> ranked(values.size());
        for (std::size_t i = 0; i < values.size(); ++i) ranked[i] = {objective(directions_[i], values[i]), i};
        std::partial_sort(ranked.begin(), ranked.begin() + 6, ranked.end(), std::greater<>());
        if (ranked[0].first <= 0) return 0.0;
        double best = ranked[0].first;
        for (int r : {0, 5}) {  // neighbours of one maximum mostly, and its rival if there is one
            best = std::max(
                best, climb([&](const glm::dvec3& d) { return objective(d, dot(coefficients, basisAt(layout_, d).data())); },
                            directions_[ranked[r].second], 0.01));
        }
        return best;
    };
    TrueExtents result;
    result.amplitude_max = maximise([](const glm::dvec3&, double f) { return std::abs(f); });
    result.radius = maximise([&](const glm::dvec3&, double f) { return visible(f); });
    for (int axis = 0; axis < 3; ++axis) {
        result.along[axis] = maximise([&](const glm::dvec3& d, double f) { return d[axis] * visible(f); });
        result.along[axis + 3] = maximise([&](const glm::dvec3& d, double f) { return -d[axis] * visible(f); });
        result.signed_extent[axis] = maximise([&](const glm::dvec3& d, double f) { return std::abs(d[axis] * f); });
    }
    return result;
}

}  // namespace radiata::testing
