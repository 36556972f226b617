// The rebased float camera against the exact rays of the double camera, from a millimetre to a thousand kilometres away.
#include "plan/camera_rays.h"

#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "base/error.h"
#include "reference/camera_rays.h"

namespace radiata::plan {
namespace {

constexpr int kWidth = 320, kHeight = 200;
/// Float rounding of a position that is built by a few operations, relative to its distance from the reference point.
constexpr double kRounding = 8.0 / (1 << 24);

/// pixelRay() of shaders/common/camera_rays.glsl, in float as there.
struct PixelRay {
    glm::vec3 origin, direction;
    float first, last;
};

PixelRay pixelRay(const shader::CameraRays& rays, const glm::vec2& point) {
    PixelRay ray;
    ray.origin = (point.x - 0.5F * kWidth) * rays.step_right + (0.5F * kHeight - point.y) * rays.step_up;
    const glm::vec3 direction = ray.origin * rays.inverse_distance + rays.forward;
    const float stretch = glm::length(direction);
    ray.direction = direction / stretch;
    ray.first = rays.near_depth * stretch;
    ray.last = rays.far_depth * stretch;
    return ray;
}

/// Distance of a world point from a ray's line, mm.
double distanceFrom(const reference::Ray& ray, const glm::dvec3& point) {
    return glm::length(glm::cross(point - ray.origin, ray.direction));
}

SceneBounds box(const glm::dvec3& centre, double half) { return {centre - half, centre + half}; }

model::Camera camera(const glm::dvec3& eye, const glm::dvec3& target, bool perspective = true) {
    model::Camera result;
    result.eye_mm = eye;
    result.target_mm = target;
    result.up = {0.1, 0.2, 1};
    result.perspective = perspective;
    return result;
}

/// All of the camera's rays, within what it says it sees, against the exact ones. The double formula itself rounds at the
/// eye's distance, hence the second term.
void expectExact(const model::Camera& view, const SceneBounds& scene) {
    const RebasedCamera rebased = rebaseCamera(view, scene, kHeight);
    ASSERT_TRUE(rebased.sees_scene);
    std::mt19937 random(7);
    std::uniform_real_distribution<float> unit(0, 1);
    for (int i = 0; i < 200; ++i) {
        const glm::vec2 point(unit(random) * kWidth, unit(random) * kHeight);
        const PixelRay ray = pixelRay(rebased.rays, point);
        const reference::Ray exact = reference::cameraRay(view, kWidth, kHeight, point.x, point.y);
        for (const float part : {0.0F, 0.5F, 1.0F}) {
            const float t = ray.first + part * (ray.last - ray.first);
            const glm::dvec3 from_reference = glm::dvec3(ray.origin) + static_cast<double>(t) * glm::dvec3(ray.direction);
            const double bound = kRounding * (glm::length(glm::dvec3(ray.origin)) + std::abs(t)) +
                                 1e-14 * (glm::length(view.eye_mm) + rebased.depth_offset_mm);
            EXPECT_LT(distanceFrom(exact, rebased.reference_mm + from_reference), bound)
                << point.x << ' ' << point.y << ' ' << t;
        }
    }
    // Both forms of the reference point.
    const glm::dvec3 offset = rebased.reference_mm - scene.centre();
    const glm::dvec3 sum = glm::dvec3(rebased.rays.reference_high) + glm::dvec3(rebased.rays.reference_low);
    EXPECT_LE(glm::length(sum - offset), glm::length(offset) * std::ldexp(1.0, -47));
    EXPECT_LE(glm::length(glm::dvec3(rebased.rays.scene_from_reference) - offset), glm::length(offset) * std::ldexp(1.0, -23));
}

TEST(CameraRays, AreExactNearAndFar) {
    const SceneBounds scene = box({12, -34, 56}, 90);
    const glm::dvec3 sight = glm::normalize(glm::dvec3(1, 2, -0.5));
    for (const double distance : {200.0, 1e3, 1e6, 1e9}) {
        model::Camera view = camera(scene.centre() - distance * sight, scene.centre());
        view.field_of_view_deg = 2 * std::atan(100 / distance) * 180 / std::numbers::pi;
        SCOPED_TRACE(distance);
        expectExact(view, scene);
        view.perspective = false;
        view.height_mm = 200;
        expectExact(view, scene);
    }
}

TEST(CameraRays, AFarCameraWithItsLensSeesWhatANearOneSees) {
    const SceneBounds scene = box(glm::dvec3(0), 50);
    // 100 mm of the plane through the centre fill the picture of each: there, all rays meet the same points.
    const auto raysFrom = [&](double distance) {
        model::Camera view = camera({0, -distance, 0}, glm::dvec3(0));
        view.up = {0, 0, 1};
        view.field_of_view_deg = 2 * std::atan(50 / distance) * 180 / std::numbers::pi;
        return rebaseCamera(view, scene, kHeight).rays;
    };
    const shader::CameraRays near = raysFrom(100), far = raysFrom(1e6);
    EXPECT_NEAR(near.step_right.x, 0.5, 1e-7);
    EXPECT_NEAR(far.step_right.x, 0.5, 1e-6);
    EXPECT_NEAR(far.step_up.z, 0.5, 1e-6);
    EXPECT_EQ(far.scene_from_reference, glm::vec3(0));
    EXPECT_NEAR(far.near_depth, -50, 1e-3);
    EXPECT_NEAR(far.far_depth, 50, 1e-3);
}

TEST(CameraRays, ReferencePointLiesInTheVisiblePartOfTheScene) {
    const SceneBounds scene = box(glm::dvec3(0), 10);
    for (const double target_y : {-99.0, -50.0, 0.0, 5.0, 300.0, 1e5}) {
        const RebasedCamera rebased = rebaseCamera(camera({0, -100, 0}, {0, target_y, 0}), scene, kHeight);
        EXPECT_LE(rebased.rays.near_depth, 0) << target_y;
        EXPECT_GE(rebased.rays.far_depth, 0) << target_y;
        EXPECT_NEAR(rebased.depth_offset_mm, std::clamp(target_y + 100, 90.0, 110.0), 1e-4);
        EXPECT_NEAR(rebased.reference_mm.y, rebased.depth_offset_mm - 100, 1e-9);
        EXPECT_NEAR(rebased.rays.near_depth + rebased.depth_offset_mm, 90, 1e-4) << "in front of the scene";
        EXPECT_NEAR(rebased.rays.far_depth + rebased.depth_offset_mm, 110, 1e-4) << "behind it";
    }
}

TEST(CameraRays, AnEyeInTheSceneSeesWhatIsBeforeIt) {
    const SceneBounds scene = box(glm::dvec3(0), 10);
    for (const double target : {1e-9, 0.5, 100.0}) {
        const model::Camera view = camera({0.25, 0, 0}, {0.25, target, 0});
        const RebasedCamera rebased = rebaseCamera(view, scene, kHeight);
        ASSERT_TRUE(rebased.sees_scene);
        EXPECT_GT(rebased.depth_offset_mm, 1e-3) << "never at the eye";
        EXPECT_NEAR(rebased.rays.near_depth + rebased.depth_offset_mm, 0, 1e-6) << "nothing behind the eye";
        EXPECT_NEAR(rebased.rays.far_depth + rebased.depth_offset_mm, 10, 1e-4);
        expectExact(view, scene);
    }
}

TEST(CameraRays, WhatIsBehindAPerspectiveEyeIsNotSeen) {
    const SceneBounds scene = box(glm::dvec3(0), 10);
    EXPECT_FALSE(rebaseCamera(camera({0, 11, 0}, {0, 12, 0}), scene, kHeight).sees_scene);
    EXPECT_TRUE(rebaseCamera(camera({0, 9, 0}, {0, 12, 0}), scene, kHeight).sees_scene);
    // An orthographic camera has no eye that anything could be behind: without clip planes nothing is cut away.
    const RebasedCamera flat = rebaseCamera(camera({0, 11, 0}, {0, 12, 0}, false), scene, kHeight);
    EXPECT_TRUE(flat.sees_scene);
    EXPECT_NEAR(flat.rays.near_depth + flat.depth_offset_mm, -21, 1e-4);
    EXPECT_NEAR(flat.rays.far_depth + flat.depth_offset_mm, -1, 1e-4);
}

TEST(CameraRays, ClipPlanesCutTheScene) {
    const SceneBounds scene = box(glm::dvec3(0), 10);
    for (const bool perspective : {true, false}) {
        model::Camera view = camera({0, -100, 0}, glm::dvec3(0), perspective);
        view.clip = model::Clip{95, 98};
        const RebasedCamera rebased = rebaseCamera(view, scene, kHeight);
        ASSERT_TRUE(rebased.sees_scene);
        EXPECT_NEAR(rebased.rays.near_depth + rebased.depth_offset_mm, 95, 1e-5);
        EXPECT_NEAR(rebased.rays.far_depth + rebased.depth_offset_mm, 98, 1e-5);
        EXPECT_GE(rebased.depth_offset_mm, 95);
        EXPECT_LE(rebased.depth_offset_mm, 98);
        expectExact(view, scene);
        view.clip = model::Clip{0, 1000};
        EXPECT_NEAR(rebaseCamera(view, scene, kHeight).rays.near_depth, -10, 1e-4) << "wider planes change nothing";
        view.clip = model::Clip{0, 89};
        EXPECT_FALSE(rebaseCamera(view, scene, kHeight).sees_scene);
        view.clip = model::Clip{111, 200};
        EXPECT_FALSE(rebaseCamera(view, scene, kHeight).sees_scene);
    }
}

TEST(CameraRays, APointSceneAndBadCamerasAreHandled) {
    const RebasedCamera rebased = rebaseCamera(camera({0, -5, 0}, glm::dvec3(0)), box(glm::dvec3(0), 0), kHeight);
    EXPECT_TRUE(rebased.sees_scene);
    EXPECT_NEAR(rebased.depth_offset_mm, 5, 1e-5);
    EXPECT_THROW(rebaseCamera(camera({0, 0, 0}, {0, 0, 0}), box(glm::dvec3(0), 1), kHeight), Error);
}

}  // namespace
}  // namespace radiata::plan
