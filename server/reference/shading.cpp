#include "reference/shading.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace radiata::reference {
namespace {

constexpr double kF0 = 0.04;
constexpr double kViewerCosineMin = 1e-3;

double tangentSquared(double cosine) { return (1 - cosine * cosine) / (cosine * cosine); }

/// Smith's Lambda for GGX.
double lambda(double alpha, double cosine) { return (std::sqrt(1 + alpha * alpha * tangentSquared(cosine)) - 1) / 2; }

/// Density of microfacet normals, per steradian and projected area.
double ggx(double alpha, double cosine) {
    const double stretch = 1 + tangentSquared(cosine) / (alpha * alpha);
    return 1 / (std::numbers::pi * alpha * alpha * std::pow(cosine, 4) * stretch * stretch);
}

}  // namespace

glm::dvec3 dielectricBrdfCosine(const glm::dvec3& base, double roughness, const glm::dvec3& normal, const glm::dvec3& viewer,
                                const glm::dvec3& light) {
    const double light_cosine = std::min(glm::dot(normal, light), 1.0);
    if (light_cosine <= 0) return glm::dvec3(0);
    const double viewer_cosine = std::clamp(glm::dot(normal, viewer), kViewerCosineMin, 1.0);
    const double alpha = roughness * roughness;
    const glm::dvec3 half = viewer + light;
    double specular = 0;
    double fresnel = 1;
    if (glm::length(half) > 0) {
        const double half_cosine = std::clamp(glm::dot(normal, glm::normalize(half)), 1e-9, 1.0);
        const double masking = 1 / (1 + lambda(alpha, viewer_cosine) + lambda(alpha, light_cosine));
        specular = ggx(alpha, half_cosine) * masking / (4 * viewer_cosine * light_cosine);
        fresnel = kF0 + (1 - kF0) * std::pow(1 - std::min(std::abs(glm::dot(viewer, glm::normalize(half))), 1.0), 5);
    }
    const glm::dvec3 diffuse = base / std::numbers::pi;
    return (diffuse + fresnel * (glm::dvec3(specular) - diffuse)) * light_cosine;
}

glm::dvec3 shadeDielectric(const glm::dvec3& base, double roughness, const glm::dvec3& normal, const glm::dvec3& viewer,
                           const glm::dvec3& light, double irradiance, double ambient) {
    return irradiance * dielectricBrdfCosine(base, roughness, normal, viewer, light) + ambient * base;
}

double srgbFromLinear(double linear) {
    const double x = std::clamp(linear, 0.0, 1.0);
    return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
}

double linearFromSrgb(double encoded) {
    const double x = std::clamp(encoded, 0.0, 1.0);
    return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
}

}  // namespace radiata::reference
