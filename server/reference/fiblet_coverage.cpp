#include "reference/fiblet_coverage.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "reference/camera_rays.h"

namespace radiata::reference {

std::vector<double> dilatedDepths(std::span<const double> depths, int columns, const model::Camera& camera, int width,
                                  int height, int texel_px, double reach_mm) {
    const glm::dvec3 forward = glm::normalize(camera.target_mm - camera.eye_mm);
    const auto rayOf = [&](std::size_t texel) {
        const int column = static_cast<int>(texel) % columns, row = static_cast<int>(texel) / columns;
        return cameraRay(camera, width, height, (column + 0.5) * texel_px, (row + 0.5) * texel_px);
    };
    std::vector<double> dilated(depths.begin(), depths.end());
    for (std::size_t i = 0; i < depths.size(); ++i) {
        const Ray to = rayOf(i);
        const glm::dvec3 centre = to.origin + (depths[i] - glm::dot(to.origin - camera.eye_mm, forward)) /
                                                  glm::dot(to.direction, forward) * to.direction;
        const double picture_mm = camera.perspective
                                      ? 2 * depths[i] * std::tan(0.5 * camera.field_of_view_deg * std::numbers::pi / 180)
                                      : camera.height_mm;
        const double radius = reach_mm + std::numbers::sqrt2 * 0.5 * texel_px * picture_mm / height;
        for (std::size_t j = 0; j < depths.size(); ++j) {
            const Ray ray = rayOf(j);
            const glm::dvec3 way = centre - ray.origin;
            const double along = glm::dot(way, ray.direction), beside2 = glm::dot(way, way) - along * along;
            if (beside2 > radius * radius) continue;
            const glm::dvec3 exit = ray.origin + (along + std::sqrt(radius * radius - beside2)) * ray.direction;
            const double depth = glm::dot(exit - camera.eye_mm, forward);
            if (depth > depths[i]) dilated[j] = std::max(dilated[j], depth);
        }
    }
    return dilated;
}

}  // namespace radiata::reference
