// Camera axes, orbits, and the sentence for every unusable camera.
#include "model/camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "base/error.h"

namespace radiata::model {
namespace {

Camera sound() {
    Camera camera;
    camera.eye_mm = {10, -20, 30};
    camera.target_mm = {1, 2, 3};
    camera.up = {0, 0, 5};
    return camera;
}

/// The message of the error that the camera gives.
std::string complaint(const Camera& camera) {
    try {
        cameraFrame(camera);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), Code::kInvalidArgument);
        return error.what();
    }
    return "accepted";
}

TEST(Camera, FrameIsOrthonormalAndRightHanded) {
    // Bound 1e-12; also for a camera a million times farther away than its target is from the origin.
    std::mt19937 random(10);
    std::normal_distribution<double> normal;
    auto vector = [&] { return glm::dvec3(normal(random), normal(random), normal(random)); };
    for (int i = 0; i < 200; ++i) {
        Camera camera;
        camera.target_mm = vector();
        camera.eye_mm = camera.target_mm + vector() * (i % 2 != 0 ? 1e6 : 1.0);
        camera.up = vector();
        const CameraFrame frame = cameraFrame(camera);
        EXPECT_NEAR(glm::length(frame.right), 1, 1e-12);
        EXPECT_NEAR(glm::length(frame.up), 1, 1e-12);
        EXPECT_NEAR(glm::dot(frame.right, frame.up), 0, 1e-12);
        EXPECT_LT(glm::length(glm::cross(frame.right, frame.up) + frame.forward), 1e-12);
        EXPECT_NEAR(glm::dot(frame.forward, glm::normalize(camera.target_mm - camera.eye_mm)), 1, 1e-12);
        EXPECT_GT(glm::dot(frame.up, camera.up), 0);
    }
}

TEST(Camera, NamesTheFieldThatIsWrong) {
    const double nan = std::nan("");
    Camera camera = sound();
    camera.eye_mm.y = nan;
    EXPECT_NE(complaint(camera).find("eye_mm"), std::string::npos);
    camera = sound();
    camera.eye_mm.z = -2e12;
    EXPECT_NE(complaint(camera).find("at most 1e12 mm"), std::string::npos) << "a blank picture would be no answer";
    camera = sound();
    camera.target_mm.x = std::numeric_limits<double>::infinity();
    EXPECT_NE(complaint(camera).find("target_mm"), std::string::npos);
    camera = sound();
    camera.up = {0, 0, 0};
    EXPECT_NE(complaint(camera).find("up is"), std::string::npos);
    camera = sound();
    camera.up = {nan, 0, 1};
    EXPECT_NE(complaint(camera).find("up is"), std::string::npos);
    camera = sound();
    camera.up = 3.0 * (camera.target_mm - camera.eye_mm);
    EXPECT_NE(complaint(camera).find("parallel"), std::string::npos);
    camera = sound();
    camera.eye_mm = camera.target_mm;
    EXPECT_NE(complaint(camera).find("must differ"), std::string::npos);
}

TEST(Camera, ChecksTheLensThatIsInUse) {
    const double nan = std::nan("");
    for (const double bad : {0.0, -1.0, nan, std::numeric_limits<double>::infinity()}) {
        Camera camera = sound();
        camera.height_mm = bad;
        EXPECT_NE(complaint(camera).find("height_mm"), std::string::npos) << bad;
        camera.perspective = true;
        EXPECT_EQ(complaint(camera), "accepted") << "height_mm is not used in perspective";
    }
    for (const double bad : {0.0, -1.0, 179.0, 360.0, nan}) {
        Camera camera = sound();
        camera.perspective = true;
        camera.field_of_view_deg = bad;
        EXPECT_NE(complaint(camera).find("field_of_view_deg"), std::string::npos) << bad;
    }
}

TEST(Camera, ClipDistancesMustBeInOrder) {
    Camera camera = sound();
    camera.clip = Clip{0, 10};
    EXPECT_EQ(complaint(camera), "accepted");
    for (const Clip bad :
         {Clip{-1, 10}, Clip{10, 10}, Clip{20, 10}, Clip{std::nan(""), 10}, Clip{0, std::numeric_limits<double>::infinity()}}) {
        camera.clip = bad;
        EXPECT_NE(complaint(camera).find("clip"), std::string::npos) << bad.nearest_mm << ' ' << bad.farthest_mm;
    }
}

TEST(Camera, OrbitKeepsDistanceAndComesBack) {
    const Camera start = sound();
    const double distance = glm::length(start.eye_mm - start.target_mm);
    Camera camera = start;
    for (int i = 0; i < 12; ++i) {
        camera = orbit(camera, 30, 0);
        EXPECT_NEAR(glm::length(camera.eye_mm - camera.target_mm), distance, 1e-10);
    }
    EXPECT_LT(glm::length(camera.eye_mm - start.eye_mm), 1e-10) << "twelve times 30 degrees is a full turn";
    camera = orbit(orbit(start, 0, 40), 0, -40);
    EXPECT_LT(glm::length(camera.eye_mm - start.eye_mm), 1e-10);
    EXPECT_EQ(camera.target_mm, start.target_mm);
}

TEST(Camera, OrbitPassesThePolesWithoutASpin) {
    Camera camera = sound();
    for (int i = 0; i < 36; ++i) {
        const CameraFrame before = cameraFrame(camera);
        camera = orbit(camera, 0, 10);
        EXPECT_GT(glm::dot(before.right, cameraFrame(camera).right), 1 - 1e-12) << "step " << i;
    }
    EXPECT_LT(glm::length(camera.eye_mm - sound().eye_mm), 1e-10);
}

}  // namespace
}  // namespace radiata::model
