#include "plan/raster_view.h"

#include <algorithm>

namespace radiata::plan {
namespace {

/// Rasterisers place corners on a grid of at most 1/16 pixel (Vulkan's least precision); floats add less than that again.
constexpr double kMarginPixels = 0.25;
/// Nearness 1 + depth / distance of the near plane, at least: 0 is the eye itself.
constexpr double kNearnessLeast = 1e-5;

}  // namespace

shader::RasterView rasterView(const shader::CameraRays& rays, int width, int height, const glm::vec2& jitter) {
    const glm::dvec3 step_right(rays.step_right), step_up(rays.step_up), forward(rays.forward);
    const double inverse_distance = rays.inverse_distance;
    // A point at depth d lies on the ray from (x, y) if its coordinates are x and y times the nearness 1 + d / distance.
    const glm::dvec4 nearness(forward * inverse_distance, 1);
    const glm::dvec4 x(step_right / glm::dot(step_right, step_right), 0), y(step_up / glm::dot(step_up, step_up), 0);
    const double nearest = std::max(1 + static_cast<double>(rays.near_depth) * inverse_distance, kNearnessLeast);
    const double first = inverse_distance > 0 ? std::max<double>(rays.near_depth, (kNearnessLeast - 1) / inverse_distance)
                                              : static_cast<double>(rays.near_depth);
    const double last = std::max<double>(rays.far_depth, first + 1e-30);
    shader::RasterView view{};
    view.row_x = glm::vec4((2.0 / width) * (x - static_cast<double>(jitter.x) * nearness));
    view.row_y = glm::vec4((2.0 / height) * (-y - static_cast<double>(jitter.y) * nearness));
    view.row_z = glm::vec4((nearest / (last - first)) * (glm::dvec4(0, 0, 0, last) - glm::dvec4(forward, 0)));
    view.row_w = glm::vec4(nearness);
    view.margin = static_cast<float>(kMarginPixels * std::max(glm::length(step_right), glm::length(step_up)));
    return view;
}

}  // namespace radiata::plan
