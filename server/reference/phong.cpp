#include "reference/phong.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace radiata::reference {
namespace {

constexpr double kExponent = 30, kShare = 0.04;

double angleBetween(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

}  // namespace

glm::dvec3 lambertReflection(const glm::dvec3& base, const glm::dvec3& normal, const glm::dvec3& light) {
    return base * (std::max(std::cos(angleBetween(normal, light)), 0.0) / std::numbers::pi);
}

glm::dvec3 phongReflection(const glm::dvec3& base, const glm::dvec3& normal, const glm::dvec3& viewer,
                           const glm::dvec3& light) {
    if (angleBetween(normal, light) >= std::numbers::pi / 2) return glm::dvec3(0);
    // The mirrored light leaves the light on the other side of the normal, as far from it: a half turn about the normal.
    const glm::dvec3 across = light - glm::dot(light, normal) * normal;
    const double off = angleBetween(light - 2.0 * across, viewer);
    const double lobe =
        off < std::numbers::pi / 2 ? (kExponent + 1) / (2 * std::numbers::pi) * std::pow(std::cos(off), kExponent) : 0;
    return lambertReflection(base, normal, light) + kShare * lobe;
}

double varyingAmbient(const glm::dvec3& normal, const glm::dvec3& light) {
    const double half = angleBetween(normal, light) / 2;
    return 2 * std::cos(half) * std::cos(half);
}

}  // namespace radiata::reference
