#include "reference/projected_cap.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "reference/sh_function.h"

namespace radiata::reference {
namespace {

/// The PCG hash RXS-M-XS 32 (O'Neill 2014) in 64-bit arithmetic.
std::uint64_t hashed(std::uint64_t x) {
    constexpr std::uint64_t kWrap = std::uint64_t{1} << 32;
    const std::uint64_t state = (x * 747796405 + 2891336453) % kWrap;
    const std::uint64_t turned = state / (std::uint64_t{1} << (state / (1 << 28) + 4));
    const std::uint64_t word = ((turned ^ state) * 277803737) % kWrap;
    return (word / (1 << 22)) ^ word;
}

}  // namespace

double integrateProjectedCap(const glm::dvec3& light, const glm::dvec3& normal, double angular_radius,
                             const std::function<double(const glm::dvec3&)>& f, int cells) {
    const glm::dvec3 x = anyOrthogonal(light), y = glm::cross(light, x);
    const double step = angular_radius / cells, turn = 2 * std::numbers::pi / (2 * cells);
    double sum = 0;
    for (int i = 0; i < cells; ++i) {
        const double polar = (i + 0.5) * step;
        for (int j = 0; j < 2 * cells; ++j) {
            const double azimuth = (j + 0.5) * turn;
            const glm::dvec3 direction =
                std::cos(polar) * light + std::sin(polar) * (std::cos(azimuth) * x + std::sin(azimuth) * y);
            const double cosine = glm::dot(direction, normal);
            if (cosine > 0) sum += cosine * f(direction) * std::sin(polar) * step * turn;
        }
    }
    return sum;
}

glm::dvec2 raySample(std::uint32_t index, std::uint32_t pixel) {
    constexpr std::uint64_t kWrap = std::uint64_t{1} << 32;
    const std::uint64_t first = hashed(pixel), second = hashed(first ^ 0x9e3779b9);
    // Steps are 1/g and 1/g^2 with g^3 = g + 1, the plastic number, rounded to 2^-32.
    const std::uint64_t x = (first + index * std::uint64_t{3242174889}) % kWrap;
    const std::uint64_t y = (second + index * std::uint64_t{2447445414}) % kWrap;
    return {std::floor(static_cast<double>(x) / 256) / 16777216, std::floor(static_cast<double>(y) / 256) / 16777216};
}

}  // namespace radiata::reference
