// Which pixels a glyph's box may touch, for what is prepared on the CPU for each camera.
#pragma once

#include "shaders/shared/frame.glsl"
#include "shaders/shared/glyph.glsl"

namespace radiata {

struct PixelRect {
    int x0 = 0, y0 = 0, x1 = -1, y1 = -1;  ///< inclusive; empty if x1 < x0
    bool empty() const { return x1 < x0; }
    double area() const { return empty() ? 0.0 : (x1 - x0 + 1.0) * (y1 - y0 + 1.0); }
};

/// The camera as a projection to pixels.
class BoxProjection {
public:
    BoxProjection(const shader::CameraRays& rays, int width, int height);

    /// Pixels of the picture whose rays, moved by up to one pixel, may meet the glyph's box; empty if the box is out of the
    /// picture or of the depth range. A box that reaches behind the eye may touch all.
    PixelRect pixels(const shader::GlyphInstance& glyph) const;
    /// Of the glyph's centre, along the line of sight from the reference plane, mm.
    float depth(const shader::GlyphInstance& glyph) const;

private:
    bool project(const glm::vec3& centre, const glm::vec3& low, const glm::vec3& high, glm::vec2& minimum,
                 glm::vec2& maximum) const;

    shader::CameraRays rays_;
    int width_, height_;
    glm::vec3 right_, up_;  ///< pixels per mm on the reference plane
};

}  // namespace radiata
