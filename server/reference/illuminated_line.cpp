#include "reference/illuminated_line.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace radiata::reference {
namespace {

/// Greatest dot product of `direction` with a normal of the cylinder about `tangent`: a coarse search, then golden sections.
double greatestCosine(const glm::dvec3& tangent, const glm::dvec3& direction) {
    const glm::dvec3 helper = std::abs(tangent.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 u = glm::normalize(glm::cross(tangent, helper)), v = glm::cross(tangent, u);
    const auto cosine = [&](double angle) { return glm::dot(std::cos(angle) * u + std::sin(angle) * v, direction); };
    constexpr int kSteps = 64;
    const double step = 2 * std::numbers::pi / kSteps;
    int best = 0;
    for (int i = 1; i < kSteps; ++i) {
        if (cosine(i * step) > cosine(best * step)) best = i;
    }
    double low = (best - 1) * step, high = (best + 1) * step;
    for (int i = 0; i < 60; ++i) {
        const double a = high - (high - low) * 0.6180339887498949, b = low + (high - low) * 0.6180339887498949;
        (cosine(a) > cosine(b) ? high : low) = cosine(a) > cosine(b) ? b : a;
    }
    return cosine(0.5 * (low + high));
}

}  // namespace

glm::dvec3 illuminatedLine(const glm::dvec3& base, double roughness, const glm::dvec3& tangent, const glm::dvec3& viewer,
                           const glm::dvec3& light) {
    const double n_l = std::max(greatestCosine(tangent, light), 0.0);
    const double n_v = std::max(greatestCosine(tangent, viewer), 1e-3);
    const glm::dvec3 between = viewer + light;
    const bool opposite = glm::length(between) < 1e-6;
    const glm::dvec3 halfway = opposite ? glm::dvec3(0) : glm::normalize(between);
    const double n_h = opposite ? 1 : greatestCosine(tangent, halfway);
    const double alpha = roughness * roughness;
    const double ggx = std::pow(alpha / (1 + n_h * n_h * (alpha * alpha - 1)), 2) / std::numbers::pi;
    const auto lambda = [&](double cosine) { return std::sqrt(alpha * alpha + (1 - alpha * alpha) * cosine * cosine); };
    const double shadowing = 0.5 / std::max(n_l * lambda(n_v) + n_v * lambda(n_l), 1e-6);
    const double fresnel = 0.04 + 0.96 * std::pow(1 - glm::dot(viewer, halfway), 5);
    return ((1 - fresnel) / std::numbers::pi * base + fresnel * ggx * shadowing) * n_l;
}

}  // namespace radiata::reference
