#include "build/box_projection.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace radiata {
namespace {

glm::vec3 centreFromReference(const shader::GlyphInstance& glyph, const shader::CameraRays& rays) {
    return (glyph.centre_high - rays.reference_high) + (glyph.centre_low - rays.reference_low);
}

}  // namespace

BoxProjection::BoxProjection(const shader::CameraRays& rays, int width, int height)
    : rays_(rays),
      width_(width),
      height_(height),
      right_(rays.step_right / glm::dot(rays.step_right, rays.step_right)),
      up_(rays.step_up / glm::dot(rays.step_up, rays.step_up)) {}

/// Bounds of a box in pixels from the picture's centre. \return false if the box is out of the depth range
bool BoxProjection::project(const glm::vec3& centre, const glm::vec3& low, const glm::vec3& high, glm::vec2& minimum,
                            glm::vec2& maximum) const {
    const glm::vec3 middle = centre + 0.5F * (low + high), half = 0.5F * (high - low);
    const float depth = glm::dot(middle, rays_.forward), depth_half = glm::dot(half, glm::abs(rays_.forward));
    if (depth + depth_half < rays_.near_depth || depth - depth_half > rays_.far_depth) return false;
    const glm::vec2 at(glm::dot(middle, right_), glm::dot(middle, up_));
    const glm::vec2 half_size(glm::dot(half, glm::abs(right_)), glm::dot(half, glm::abs(up_)));
    // Perspective divides by 1 + depth / distance, which is monotonic: its extremes over the box bound all quotients.
    const float nearest = 1 + (depth - depth_half) * rays_.inverse_distance;
    const float farthest = 1 + (depth + depth_half) * rays_.inverse_distance;
    if (nearest <= 1e-4F) {
        minimum = glm::vec2(-std::numeric_limits<float>::max());
        maximum = glm::vec2(std::numeric_limits<float>::max());
        return true;
    }
    const glm::vec2 first = at - half_size, last = at + half_size;
    minimum = glm::min(first / nearest, first / farthest);
    maximum = glm::max(last / nearest, last / farthest);
    return true;
}

PixelRect BoxProjection::pixels(const shader::GlyphInstance& glyph) const {
    glm::vec2 minimum, maximum;
    if (!project(centreFromReference(glyph, rays_), glyph.box_min, glyph.box_max, minimum, maximum)) return {};
    const float w = static_cast<float>(width_), h = static_cast<float>(height_);
    auto pixel = [](float value, float limit) { return static_cast<int>(std::floor(std::clamp(value, -1.0F, limit))); };
    const int x0 = pixel(minimum.x + 0.5F * w - 1, w), x1 = pixel(maximum.x + 0.5F * w + 1, w);
    const int y0 = pixel(0.5F * h - maximum.y - 1, h), y1 = pixel(0.5F * h - minimum.y + 1, h);
    if (x1 < 0 || y1 < 0 || x0 >= width_ || y0 >= height_) return {};
    return {std::max(x0, 0), std::max(y0, 0), std::min(x1, width_ - 1), std::min(y1, height_ - 1)};
}

float BoxProjection::depth(const shader::GlyphInstance& glyph) const {
    return glm::dot(centreFromReference(glyph, rays_), rays_.forward);
}

}  // namespace radiata
