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
/// One page in so many may be beside a picture that is told to have all.
constexpr std::size_t kPagesInside = 16;

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

bool areInside(const shader::FibletView& view, std::span<const shader::FibletPage> pages) {
    const auto beside = std::ranges::count_if(pages, [&view](const shader::FibletPage& page) {
        const glm::vec3 middle = 0.5F * (page.low + page.high) - view.reference_high - view.reference_low;
        const float depth = glm::dot(view.forward, middle), nearness = 1 + depth * view.inverse_distance;
        if (!(depth >= view.near_depth && depth <= view.far_depth && nearness > 0)) return true;
        const glm::vec2 at = view.centre + glm::vec2(glm::dot(view.right, middle), -glm::dot(view.up, middle)) / nearness -
                             glm::vec2(view.window_x, view.window_y);
        return !(at.x >= 0 && at.y >= 0 && at.x < static_cast<float>(view.width) && at.y < static_cast<float>(view.height));
    });
    return static_cast<std::size_t>(beside) * kPagesInside <= pages.size();
}

}  // namespace radiata::plan
