#include "plan/fiblet_view.h"

#include <algorithm>

#include "math/two_floats.h"

namespace radiata::plan {
namespace {

/// Nearness of the near plane, at least: 0 is the eye itself.
constexpr double kNearnessLeast = 1e-5;
/// Of the coordinates that a position or depth is made of: a few roundings of float; and what decoding on the device may differ
/// from decoding on the CPU, where boxes were made, mm.
constexpr double kRounding = 5e-7;
constexpr double kDecoding = 3e-4;

}  // namespace

shader::FibletView fibletView(const shader::CameraRays& rays, const glm::ivec2& picture, const PixelWindow& window,
                              const glm::vec2& jitter, const glm::dvec3& reference_from_origin, double reach_mm) {
    const glm::dvec3 right(rays.step_right), up(rays.step_up);
    shader::FibletView view{};
    view.right = glm::vec3(right / glm::dot(right, right));
    view.up = glm::vec3(up / glm::dot(up, up));
    view.forward = rays.forward;
    view.inverse_distance = rays.inverse_distance;
    view.near_depth = rays.near_depth;
    if (rays.inverse_distance > 0) {
        const double eye = (kNearnessLeast - 1) / static_cast<double>(rays.inverse_distance);
        view.near_depth = std::max(view.near_depth, static_cast<float>(eye));
    }
    view.far_depth = rays.far_depth;
    const TwoFloats reference = twoFloats(reference_from_origin);
    view.reference_high = reference.high;
    view.reference_low = reference.low;
    view.centre = 0.5F * glm::vec2(picture) - jitter;
    view.window_x = window.first.x;
    view.window_y = window.first.y;
    view.width = window.size.x;
    view.height = window.size.y;
    view.rounding = static_cast<float>(kDecoding + kRounding * (reach_mm + glm::length(reference_from_origin)));
    view.line_width = 1;
    return view;
}

}  // namespace radiata::plan
