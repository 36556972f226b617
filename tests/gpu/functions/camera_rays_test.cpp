// Rays of the rebased float32 camera against double world coordinates: they pass the points that they should within 2e-5 mm in
// a scene of 200 mm, wherever the camera stands, and begin and end outside of the scene.
#include "reference/camera_rays.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>

#include "gpu/functions/function_runner.h"
#include "plan/camera_rays.h"
#include "shaders/test/camera_io.glsl"

namespace radiata {
namespace {

using shader::CameraInput;
using shader::CameraOutput;

constexpr int kWidth = 1280, kHeight = 720;
const plan::SceneBounds kScene{{900, -600, 150}, {1100, -400, 350}};

struct Case {
    const char* name;
    model::Camera camera;
    bool inside = false;  // the eye stands in the scene
};

model::Camera cameraAt(const glm::dvec3& towards_eye, double distance, bool perspective, double height_mm) {
    model::Camera camera;
    camera.target_mm = kScene.centre() + glm::dvec3(3, -2, 5);
    camera.eye_mm = camera.target_mm + distance * glm::normalize(towards_eye);
    camera.up = {0.1, 0.2, 1};
    camera.perspective = perspective;
    camera.height_mm = height_mm;
    camera.field_of_view_deg = 2 * std::atan(0.5 * height_mm / distance) * 180 / std::numbers::pi;
    return camera;
}

std::vector<Case> cases() {
    std::vector<Case> all;
    for (const glm::dvec3& way : {glm::dvec3(1, 0, 0), glm::dvec3(0.3, -0.8, 0.5), glm::dvec3(-0.5, 0.1, -0.7)}) {
        all.push_back({"orthographic", cameraAt(way, 500, false, 220)});
        all.push_back({"orthographic, 1e6 radii away", cameraAt(way, 1.7e8, false, 220)});
        all.push_back({"orthographic, in the scene", cameraAt(way, 20, false, 100), true});
        all.push_back({"perspective", cameraAt(way, 500, true, 220)});
        all.push_back({"perspective, close", cameraAt(way, 190, true, 220)});
        all.push_back({"perspective, 1e6 radii away", cameraAt(way, 1.7e8, true, 220)});
        all.push_back({"perspective, in the scene", cameraAt(way, 20, true, 15), true});
    }
    return all;
}

/// Parameters, from the eye, at which a ray enters and leaves the scene's box; entry > exit if it does not.
glm::dvec2 sceneSpan(const reference::Ray& ray) {
    glm::dvec2 span(-1e300, 1e300);
    for (int i = 0; i < 3; ++i) {
        const double a = (kScene.minimum[i] - ray.origin[i]) / ray.direction[i];
        const double b = (kScene.maximum[i] - ray.origin[i]) / ray.direction[i];
        if (std::isnan(a) || std::isnan(b)) continue;
        span.x = std::max(span.x, std::min(a, b));
        span.y = std::min(span.y, std::max(a, b));
    }
    return span;
}

using CameraRayFunctions = test::FunctionTest;

TEST_F(CameraRayFunctions, PassThePointsOfTheirTwins) {
    std::mt19937 random(19);
    std::uniform_real_distribution<float> unit(0, 1);
    for (const Case& x : cases()) {
        const plan::RebasedCamera rebased = plan::rebaseCamera(x.camera, kScene, kHeight);
        ASSERT_TRUE(rebased.sees_scene) << x.name;
        std::vector<CameraInput> inputs;
        for (int i = 0; i < 500; ++i) {
            inputs.push_back({rebased.rays, {kWidth, kHeight}, {kWidth * unit(random), kHeight * unit(random)}});
        }
        const auto outputs = runFunction<CameraOutput>("test_camera_rays", {}, inputs);
        double worst = 0, too_late = 0, too_early = 0;
        int in_scene = 0;
        for (std::size_t i = 0; i < inputs.size(); ++i) {
            const reference::Ray ray =
                reference::cameraRay(x.camera, kWidth, kHeight, double(inputs[i].point.x), double(inputs[i].point.y));
            const glm::dvec2 span = sceneSpan(ray);
            const double entry = x.inside && x.camera.perspective ? std::max(span.x, 0.0) : span.x;
            if (!(entry < span.y)) continue;
            ++in_scene;
            const glm::dvec3 origin = rebased.reference_mm + glm::dvec3(outputs[i].origin);
            const glm::dvec3 direction(outputs[i].direction);
            for (const double fraction : {0.0, 0.25, 0.5, 0.75, 1.0}) {
                const glm::dvec3 point = ray.origin + (entry + fraction * (span.y - entry)) * ray.direction;
                const double t = glm::dot(point - origin, direction) / glm::dot(direction, direction);
                worst = std::max(worst, glm::length(point - origin - t * direction));
                too_late = std::max(too_late, double(outputs[i].first) - t);
                too_early = std::max(too_early, t - double(outputs[i].last));
            }
        }
        std::printf("%-30s %d rays, off by %.2g mm at most\n", x.name, in_scene, worst);
        EXPECT_GT(in_scene, 100) << x.name;
        EXPECT_LT(worst, 2e-5) << x.name;
        EXPECT_LT(too_late, 1e-4) << x.name;
        EXPECT_LT(too_early, 1e-4) << x.name;
    }
}

}  // namespace
}  // namespace radiata
