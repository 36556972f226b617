// The projection for the rasteriser against the rays of its twin: points on a pixel's ray are drawn at the pixel's centre.
#include "plan/raster_view.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "plan/camera_rays.h"
#include "reference/camera_rays.h"

namespace radiata::plan {
namespace {

constexpr int kWidth = 1280, kHeight = 720;
const SceneBounds kScene{{900, -600, 150}, {1100, -400, 350}};

model::Camera camera(double distance, bool perspective) {
    model::Camera camera;
    camera.target_mm = kScene.centre() + glm::dvec3(3, -2, 5);
    camera.eye_mm = camera.target_mm + distance * glm::normalize(glm::dvec3(0.3, -0.8, 0.5));
    camera.up = {0.1, 0.2, 1};
    camera.perspective = perspective;
    camera.height_mm = 220;
    camera.field_of_view_deg = distance > 1e4 ? 0.01 : 40;
    return camera;
}

/// The vertex shaders' arithmetic, in float.
glm::vec4 project(const shader::RasterView& view, const glm::vec3& p) {
    const glm::vec4 q(p, 1);
    return {glm::dot(view.row_x, q), glm::dot(view.row_y, q), glm::dot(view.row_z, q), glm::dot(view.row_w, q)};
}

TEST(RasterView, DrawsPointsOfARayAtTheCentreOfItsPixel) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(0, 1);
    for (const bool perspective : {false, true}) {
        for (const double distance : {20.0, 190.0, 500.0, 1.2e6}) {
            const model::Camera view_from = camera(distance, perspective);
            const RebasedCamera rebased = rebaseCamera(view_from, kScene, kHeight);
            const glm::vec2 jitter(0.3, -0.41);
            const shader::RasterView view = rasterView(rebased.rays, kWidth, kHeight, jitter);
            double worst = 0;
            for (int i = 0; i < 2000; ++i) {
                const int column = int(kWidth * unit(random)), row = int(kHeight * unit(random));
                const reference::Ray ray =
                    reference::cameraRay(view_from, kWidth, kHeight, column + 0.5 + jitter.x, row + 0.5 + jitter.y);
                // In the depth range of the scene; a camera within begins a millimetre before the eye.
                const double along = glm::dot(ray.direction, glm::normalize(view_from.target_mm - view_from.eye_mm));
                const double start =
                    glm::dot(ray.origin - view_from.eye_mm, glm::normalize(view_from.target_mm - view_from.eye_mm));
                const double near_mm = rebased.depth_offset_mm + double(rebased.rays.near_depth);
                const double far_mm = rebased.depth_offset_mm + double(rebased.rays.far_depth);
                const double first = perspective ? std::max(near_mm, 1.0) : near_mm;
                const double depth = first + (0.001 + 0.998 * unit(random)) * (far_mm - first);
                const glm::dvec3 point = ray.origin + (depth - start) / along * ray.direction;
                const glm::vec4 clip = project(view, glm::vec3(point - rebased.reference_mm));
                ASSERT_GT(clip.w, 0);
                const double x = (clip.x / clip.w * 0.5 + 0.5) * kWidth, y = (clip.y / clip.w * 0.5 + 0.5) * kHeight;
                worst = std::max({worst, std::abs(x - column - 0.5), std::abs(y - row - 0.5)});
                EXPECT_GT(clip.z, 0);
                EXPECT_LT(clip.z, clip.w * 1.00001F);
            }
            std::printf("%s, %g mm away: off by %.2g pixels at most\n", perspective ? "perspective" : "orthographic", distance,
                        worst);
            EXPECT_LT(worst, 1e-3);
        }
    }
}

TEST(RasterView, LetsDepthFallAwayFromTheViewer) {
    for (const bool perspective : {false, true}) {
        for (const double distance : {20.0, 500.0, 1.2e6}) {
            const RebasedCamera rebased = rebaseCamera(camera(distance, perspective), kScene, kHeight);
            const shader::RasterView view = rasterView(rebased.rays, kWidth, kHeight, {0, 0});
            const glm::vec3 forward = rebased.rays.forward;
            double before = 2;
            for (int i = 0; i <= 1000; ++i) {
                const float depth = glm::mix(rebased.rays.near_depth, rebased.rays.far_depth, float(i) / 1000);
                const glm::vec4 clip = project(view, depth * forward);
                if (clip.z > clip.w) continue;  // in front of the near plane of a camera within the scene
                EXPECT_LT(clip.z / clip.w, before);
                before = clip.z / clip.w;
            }
            EXPECT_NEAR(before, 0, 1e-6);
        }
    }
}

}  // namespace
}  // namespace radiata::plan
