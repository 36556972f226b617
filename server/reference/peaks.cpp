#include "reference/peaks.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace radiata::reference {
namespace {

constexpr int kSamples = 41253;  // one a square degree
constexpr double kNear = 2.5 * std::numbers::pi / 180;
constexpr double kFirstStep = 0.02, kLastStep = 1e-8;  // radians
constexpr double kSame = 1e-3;

model::Peak follow(const ShFunction& f, glm::dvec3 p) {
    double value = f(p);
    for (double step = kFirstStep; step > kLastStep;) {
        const glm::dvec3 u = anyOrthogonal(p), v = glm::cross(p, u);
        bool moved = false;
        for (const glm::dvec3& way : {u, v, -u, -v}) {
            const glm::dvec3 q = glm::normalize(p + step * way);
            const double there = f(q);
            if (there <= value) continue;
            value = there;
            p = q;
            moved = true;
            break;
        }
        if (!moved) step *= 0.5;
    }
    return {p, value};
}

}  // namespace

std::vector<model::Peak> peaks(const ShFunction& f) {
    // Spiral of equal areas, by descending z, so that near samples have near numbers.
    std::vector<glm::dvec3> directions(kSamples);
    std::vector<double> values(kSamples);
    for (int i = 0; i < kSamples; ++i) {
        const double z = 1 - (2 * i + 1.0) / kSamples, angle = std::numbers::pi * (3 - std::sqrt(5.0)) * i;
        const double r = std::sqrt(1 - z * z);
        directions[static_cast<std::size_t>(i)] = {r * std::cos(angle), r * std::sin(angle), z};
        values[static_cast<std::size_t>(i)] = f(directions[static_cast<std::size_t>(i)]);
    }
    const auto window = static_cast<std::size_t>(kNear * kSamples / 2) + 1;
    std::vector<model::Peak> found;
    for (std::size_t i = 0; i < directions.size(); ++i) {
        bool highest = values[i] > 0;
        const std::size_t first = i > window ? i - window : 0, last = std::min(directions.size(), i + window + 1);
        for (std::size_t j = first; highest && j < last; ++j) {
            highest = values[j] <= values[i] || glm::dot(directions[i], directions[j]) < std::cos(kNear);
        }
        if (!highest) continue;
        const model::Peak peak = follow(f, directions[i]);
        const bool known = std::ranges::any_of(
            found, [&](const model::Peak& other) { return glm::length(other.direction - peak.direction) < kSame; });
        if (!known) found.push_back(peak);
    }
    std::ranges::stable_sort(found, std::ranges::greater{}, &model::Peak::amplitude);
    return found;
}

}  // namespace radiata::reference
