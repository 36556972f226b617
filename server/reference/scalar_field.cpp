#include "reference/scalar_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace radiata::reference {
namespace {

/// Weights of four neighbouring samples of a uniform cubic B-spline at fraction u, and their derivatives.
std::array<double, 4> splineWeights(double u) {
    const double v = 1 - u;
    return {v * v * v / 6, (3 * u * u * u - 6 * u * u + 4) / 6, (3 * v * v * v - 6 * v * v + 4) / 6, u * u * u / 6};
}
std::array<double, 4> splineSlopes(double u) {
    const double v = 1 - u;
    return {-v * v / 2, (3 * u * u - 4 * u) / 2, (4 * v - 3 * v * v) / 2, u * u / 2};
}

/// The stretch of a ray inside the box [0, high].
std::pair<double, double> clip(const glm::dvec3& origin, const glm::dvec3& direction, const glm::dvec3& high, double t_max) {
    double begin = 0, end = t_max;
    for (int axis = 0; axis < 3; ++axis) {
        if (direction[axis] == 0) {
            if (origin[axis] < 0 || origin[axis] > high[axis]) return {1, 0};
            continue;
        }
        double a = -origin[axis] / direction[axis], b = (high[axis] - origin[axis]) / direction[axis];
        if (a > b) std::swap(a, b);
        begin = std::max(begin, a);
        end = std::min(end, b);
    }
    return {begin, end};
}

}  // namespace

ScalarField::ScalarField(glm::ivec3 size, std::vector<double> values) : size_(size), values_(std::move(values)) {}

ScalarField::ScalarField(glm::ivec3 size, const std::function<double(const glm::dvec3&)>& function) : size_(size) {
    for (int z = 0; z < size.z; ++z) {
        for (int y = 0; y < size.y; ++y) {
            for (int x = 0; x < size.x; ++x) values_.push_back(function(glm::dvec3(x, y, z)));
        }
    }
}

double ScalarField::sample(int x, int y, int z) const {
    x = std::clamp(x, 0, size_.x - 1);
    y = std::clamp(y, 0, size_.y - 1);
    z = std::clamp(z, 0, size_.z - 1);
    return values_[static_cast<std::size_t>((z * size_.y + y) * size_.x + x)];
}

bool ScalarField::holds(const glm::dvec3& p) const {
    return p.x >= 0 && p.y >= 0 && p.z >= 0 && p.x <= size_.x - 1 && p.y <= size_.y - 1 && p.z <= size_.z - 1;
}

double ScalarField::value(const glm::dvec3& position) const {
    const glm::dvec3 p = glm::clamp(position, glm::dvec3(0), glm::dvec3(size_ - 1));
    const glm::ivec3 c = glm::min(glm::ivec3(glm::floor(p)), glm::max(size_ - 2, glm::ivec3(0)));
    const glm::dvec3 u = p - glm::dvec3(c);
    double result = 0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::ivec3 o(corner & 1, (corner >> 1) & 1, corner >> 2);
        const glm::dvec3 w = glm::mix(1.0 - u, u, glm::dvec3(o));
        result += w.x * w.y * w.z * sample(c.x + o.x, c.y + o.y, c.z + o.z);
    }
    return result;
}

glm::dvec3 ScalarField::smoothGradient(const glm::dvec3& p) const {
    const glm::ivec3 c(glm::floor(p));
    std::array<std::array<double, 4>, 3> weights, slopes;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto i = static_cast<int>(axis);
        weights[axis] = splineWeights(p[i] - c[i]);
        slopes[axis] = splineSlopes(p[i] - c[i]);
    }
    glm::dvec3 gradient(0);
    for (int z = 0; z < 4; ++z) {
        for (int y = 0; y < 4; ++y) {
            for (int x = 0; x < 4; ++x) {
                const double s = sample(c.x + x - 1, c.y + y - 1, c.z + z - 1);
                const auto i = static_cast<std::size_t>(x), j = static_cast<std::size_t>(y), k = static_cast<std::size_t>(z);
                gradient +=
                    s * glm::dvec3(slopes[0][i] * weights[1][j] * weights[2][k], weights[0][i] * slopes[1][j] * weights[2][k],
                                   weights[0][i] * weights[1][j] * slopes[2][k]);
            }
        }
    }
    return gradient;
}

glm::dvec3 ScalarField::outwardNormal(const glm::dvec3& p) const {
    const glm::dvec3 gradient = smoothGradient(p);
    const double length = glm::length(gradient);
    return length > 0 ? -gradient / length : glm::dvec3(0);
}

std::optional<double> ScalarField::firstCrossing(const glm::dvec3& origin, const glm::dvec3& direction, double t_max,
                                                 double iso, double step) const {
    const auto [begin, end] = clip(origin, direction, glm::dvec3(size_ - 1), t_max);
    if (!(begin < end)) return std::nullopt;
    // Seen from the side where the ray begins, values are below until the surface.
    const double side = value(origin + begin * direction) > iso ? -1 : 1;
    const auto beyond = [&](double t) { return side * (value(origin + t * direction) - iso); };
    const auto bisect = [&](double low, double high) {
        while (high - low > 1e-10) {
            const double middle = 0.5 * (low + high);
            (beyond(middle) > 0 ? high : low) = middle;
        }
        return high;
    };
    double t = begin, f = beyond(t), f_before = f;
    while (t < end) {
        const double next = std::min(t + step, end), f_next = beyond(next);
        if (f <= 0 && f_next > 0) return bisect(t, next);
        if (f >= f_before && f >= f_next && t > begin) {
            // A maximum lies near t: the parabola through the three values says where it may be beyond.
            const double bend = f_before - 2 * f + f_next;
            const double peak = bend < 0 ? t + 0.5 * step * (f_before - f_next) / bend : t;
            if (beyond(peak) > 0) return bisect(std::max(peak - step, begin), peak);
        }
        f_before = f;
        f = f_next;
        t = next;
    }
    return std::nullopt;
}

}  // namespace radiata::reference
