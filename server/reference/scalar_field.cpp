#include "reference/scalar_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "reference/cubic.h"

namespace radiata::reference {
namespace {

/// Uniform B-spline of the given degree, its support centred on 0, by the recursion of Cox and de Boor.
double bSpline(int degree, double x) {
    if (degree == 0) return x >= -0.5 && x < 0.5 ? 1 : 0;
    const double half = 0.5 * (degree + 1);
    return ((half + x) * bSpline(degree - 1, x + 0.5) + (half - x) * bSpline(degree - 1, x - 0.5)) / degree;
}

/// Of the four samples around p along one axis: the cubic spline's weights and their derivatives. The derivative of a B-spline
/// is the difference of two of the degree below, half a step to either side.
struct AxisWeights {
    int first;
    std::array<double, 4> weight, slope;

    explicit AxisWeights(double p) : first(static_cast<int>(std::floor(p)) - 1) {
        for (std::size_t i = 0; i < 4; ++i) {
            const double x = p - (first + static_cast<double>(i));
            weight[i] = bSpline(3, x);
            slope[i] = bSpline(2, x + 0.5) - bSpline(2, x - 0.5);
        }
    }
};

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

ScalarField::ScalarField(const model::ScalarImage& image)
    : size_(image.size), values_(image.values.begin(), image.values.end()) {}

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

double ScalarField::extended(glm::ivec3 at) const {
    for (int axis = 0; axis < 3; ++axis) {
        const int last = size_[axis] - 1;
        if ((at[axis] >= 0 && at[axis] <= last) || last == 0) continue;
        // From the two samples that are nearest along this axis, each extended along the others.
        const int face = at[axis] < 0 ? 0 : last, inner = at[axis] < 0 ? 1 : last - 1, steps = std::abs(at[axis] - face);
        glm::ivec3 one = at, other = at;
        one[axis] = face;
        other[axis] = inner;
        return (1 + steps) * extended(one) - steps * extended(other);
    }
    return sample(at.x, at.y, at.z);
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

glm::ivec3 ScalarField::cellOf(const glm::dvec3& p) const {
    return glm::clamp(glm::ivec3(glm::floor(p)), glm::ivec3(0), glm::max(size_ - 2, glm::ivec3(0)));
}

std::array<double, 8> ScalarField::cornersOf(const glm::ivec3& cell) const {
    std::array<double, 8> corners{};
    for (int n = 0; n < 8; ++n) {
        corners[static_cast<std::size_t>(n)] = sample(cell.x + (n & 1), cell.y + (n >> 1 & 1), cell.z + (n >> 2));
    }
    return corners;
}

glm::dvec3 ScalarField::gradient(const glm::dvec3& p) const {
    // Along each axis the trilinear function is linear, so its slope is the difference of its ends.
    const glm::ivec3 cell = cellOf(p);
    const std::array<double, 8> corners = cornersOf(cell);
    glm::dvec3 gradient;
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 low = p - glm::dvec3(cell), high = low;
        low[axis] = 0;
        high[axis] = 1;
        gradient[axis] = cellValue(corners, high) - cellValue(corners, low);
    }
    return gradient;
}

double ScalarField::splineValue(const glm::dvec3& p) const {
    const AxisWeights x(p.x), y(p.y), z(p.z);
    double sum = 0;
    for (int n = 0; n < 64; ++n) {
        const int i = n & 3, j = n >> 2 & 3, k = n >> 4;
        sum += x.weight[static_cast<std::size_t>(i)] * y.weight[static_cast<std::size_t>(j)] *
               z.weight[static_cast<std::size_t>(k)] * extended({x.first + i, y.first + j, z.first + k});
    }
    return sum;
}

glm::dvec3 ScalarField::splineGradient(const glm::dvec3& p) const {
    const AxisWeights x(p.x), y(p.y), z(p.z);
    glm::dvec3 sum(0);
    for (std::size_t n = 0; n < 64; ++n) {
        const std::size_t i = n & 3U, j = n >> 2U & 3U, k = n >> 4U;
        const double value =
            extended({x.first + static_cast<int>(i), y.first + static_cast<int>(j), z.first + static_cast<int>(k)});
        sum += value * glm::dvec3(x.slope[i] * y.weight[j] * z.weight[k], x.weight[i] * y.slope[j] * z.weight[k],
                                  x.weight[i] * y.weight[j] * z.slope[k]);
    }
    return sum;
}

glm::dvec3 ScalarField::outwardNormal(const glm::dvec3& p) const {
    const glm::dvec3 gradient = splineGradient(p);
    const double length = glm::length(gradient);
    return length > 0 ? -gradient / length : glm::dvec3(0);
}

std::optional<ScalarField::Hit> ScalarField::firstHit(const glm::dvec3& origin, const glm::dvec3& direction, double iso,
                                                      double t_min, double t_max) const {
    // Where the ray is within the volume at all, and every parameter at which it crosses a plane of the grid.
    double begin = t_min, end = t_max;
    std::vector<double> crossings;
    for (int axis = 0; axis < 3; ++axis) {
        const double last = size_[axis] - 1;
        if (direction[axis] == 0) {
            if (origin[axis] < 0 || origin[axis] > last) return std::nullopt;
            continue;
        }
        const double a = -origin[axis] / direction[axis], b = (last - origin[axis]) / direction[axis];
        begin = std::max(begin, std::min(a, b));
        end = std::min(end, std::max(a, b));
        for (int plane = 0; plane < size_[axis]; ++plane) crossings.push_back((plane - origin[axis]) / direction[axis]);
    }
    if (!(begin <= end)) return std::nullopt;
    std::erase_if(crossings, [&](double t) { return t <= begin || t >= end; });
    crossings.push_back(end);
    std::ranges::sort(crossings);
    double from = begin;
    for (const double to : crossings) {
        const glm::ivec3 cell = cellOf(origin + 0.5 * (from + to) * direction);
        const std::array<double, 8> corners = cornersOf(cell);
        if (std::ranges::all_of(corners, [](double corner) { return std::isfinite(corner); })) {
            const auto place = [&](double t) {
                return glm::clamp(origin + t * direction - glm::dvec3(cell), glm::dvec3(0), glm::dvec3(1));
            };
            if (const auto root = firstChordRoot(corners, iso, place(from), place(to))) {
                return Hit{from + root->u * (to - from), root->margin};
            }
        }
        from = to;
    }
    return std::nullopt;
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
