#include "reference/glyph_bounds.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

namespace radiata::reference {
namespace {

constexpr int kSamples = 8192;

std::vector<glm::dvec3> fibonacciSphere() {
    std::vector<glm::dvec3> points(kSamples);
    for (int i = 0; i < kSamples; ++i) {
        const double z = 1 - (2.0 * i + 1) / kSamples;
        const double angle = 2 * std::numbers::pi * i * (std::numbers::phi - 1);
        points[std::size_t(i)] = {std::sqrt(1 - z * z) * std::cos(angle), std::sqrt(1 - z * z) * std::sin(angle), z};
    }
    return points;
}

/// Walks uphill on the sphere in steps of halving length. \return the value reached
double climb(const std::function<double(const glm::dvec3&)>& value, glm::dvec3 p, double step) {
    double best = value(p);
    while (step > 1e-9) {
        const glm::dvec3 u = anyOrthogonal(p), v = glm::cross(p, u);
        bool moved = false;
        for (const glm::dvec3& tangent : {u, -u, v, -v}) {
            const glm::dvec3 next = glm::normalize(p + step * tangent);
            if (const double next_value = value(next); next_value > best) {
                best = next_value;
                p = next;
                moved = true;
                break;
            }
        }
        if (!moved) step /= 2;
    }
    return best;
}

/// Largest value of a piecewise polynomial function of given degree on the sphere, at least 0.
double maximise(const std::vector<glm::dvec3>& points, int degree, double size,
                const std::function<double(const glm::dvec3&)>& value) {
    // No point of the sphere is farther than this from a sample (measured: 0.69 to 0.78 instead of 0.85).
    const double reach = 0.85 * std::sqrt(4 * std::numbers::pi / kSamples);
    std::vector<double> values;
    for (const glm::dvec3& p : points) values.push_back(value(p));
    const double best = std::max(0.0, *std::max_element(values.begin(), values.end()));
    // Within `reach` of the maximum a polynomial of that size falls by at most size (degree reach)^2 / 2 (Bernstein).
    const double worth = best - size * std::pow(degree * reach, 2) / 2;
    double reached = best;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (values[i] > std::max(worth, 0.0)) reached = std::max(reached, climb(value, points[i], reach / 2));
    }
    return reached;
}

}  // namespace

GlyphBounds glyphBounds(const ShFunction& f, bool both_lobes) {
    const std::vector<glm::dvec3> points = fibonacciSphere();
    const int degree = f.layout().lmax;
    double size = 0;
    for (const glm::dvec3& p : points) size = std::max(size, std::abs(f(p)));
    size *= 1.2;  // between samples; 1 / cos(16 reach) = 1.14
    const auto radius = [&](const glm::dvec3& p) { return both_lobes ? std::abs(f(p)) : std::max(f(p), 0.0); };
    GlyphBounds bounds;
    bounds.radius = maximise(points, degree, size, radius);
    for (int axis = 0; axis < 3; ++axis) {
        bounds.max[axis] = maximise(points, degree + 1, size, [&](const glm::dvec3& p) { return radius(p) * p[axis]; });
        bounds.min[axis] = -maximise(points, degree + 1, size, [&](const glm::dvec3& p) { return -radius(p) * p[axis]; });
    }
    return bounds;
}

}  // namespace radiata::reference
