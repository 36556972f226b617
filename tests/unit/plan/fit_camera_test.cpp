// Which way the default cameras show the head: where the patient's left, front and top come to lie in the picture, by
// projecting points with the reference camera; and that everything fits.
#include "plan/fit_camera.h"

#include <gtest/gtest.h>

#include "reference/camera_rays.h"

namespace radiata::plan {
namespace {

using model::Convention;
using model::Plane;

const SceneBounds kHead{{-70, -100, -60}, {80, 110, 75}};

model::VoxelSelection slice(Plane plane, const glm::dvec3& normal = {0, 0, 1}) {
    model::VoxelSelection selection;
    selection.region = model::Region::kSlice;
    selection.plane = plane;
    selection.normal = normal;
    return selection;
}

/// Pixels to the right and up that a world direction from the bounds' centre takes in a square picture of 200 pixels.
struct Way {
    double right, up;
};

Way wayOf(const model::Camera& camera, const glm::dvec3& direction) {
    const glm::dvec3 at = reference::projectPoint(camera, 200, 200, kHead.centre() + direction);
    return {at.x - 100, 100 - at.y};
}

constexpr glm::dvec3 kLeft(-10, 0, 0), kFront(0, 10, 0), kTop(0, 0, 10);  // RAS

TEST(FitCamera, AxialRadiologicalHasThePatientsLeftOnTheRight) {
    const model::Camera camera = fitCamera(kHead, slice(Plane::kAxial), Convention::kRadiological, 1);
    EXPECT_GT(wayOf(camera, kLeft).right, 1);
    EXPECT_GT(wayOf(camera, kFront).up, 1);
    EXPECT_LT(camera.eye_mm.z, kHead.minimum.z) << "seen from the feet";
    EXPECT_FALSE(camera.perspective);
}

TEST(FitCamera, AxialNeurologicalIsMirrored) {
    const model::Camera camera = fitCamera(kHead, slice(Plane::kAxial), Convention::kNeurological, 1);
    EXPECT_LT(wayOf(camera, kLeft).right, -1);
    EXPECT_GT(wayOf(camera, kFront).up, 1);
    EXPECT_GT(camera.eye_mm.z, kHead.maximum.z) << "seen from above";
}

TEST(FitCamera, CoronalFollowsTheConvention) {
    const model::Camera front = fitCamera(kHead, slice(Plane::kCoronal), Convention::kRadiological, 1);
    EXPECT_GT(wayOf(front, kLeft).right, 1);
    EXPECT_GT(wayOf(front, kTop).up, 1);
    EXPECT_GT(front.eye_mm.y, kHead.maximum.y) << "face to face";
    const model::Camera behind = fitCamera(kHead, slice(Plane::kCoronal), Convention::kNeurological, 1);
    EXPECT_LT(wayOf(behind, kLeft).right, -1);
    EXPECT_GT(wayOf(behind, kTop).up, 1);
}

TEST(FitCamera, SagittalHasTheNoseToTheLeftInBothConventions) {
    for (const Convention convention : {Convention::kRadiological, Convention::kNeurological}) {
        const model::Camera camera = fitCamera(kHead, slice(Plane::kSagittal), convention, 1);
        EXPECT_LT(wayOf(camera, kFront).right, -1);
        EXPECT_GT(wayOf(camera, kTop).up, 1);
        EXPECT_LT(camera.eye_mm.x, kHead.minimum.x) << "seen from the left";
    }
}

TEST(FitCamera, AWholeVolumeIsSeenAsAnAxialSliceIs) {
    for (const Convention convention : {Convention::kRadiological, Convention::kNeurological}) {
        EXPECT_EQ(fitCamera(kHead, {}, convention, 1.5), fitCamera(kHead, slice(Plane::kAxial), convention, 1.5));
    }
}

TEST(FitCamera, ObliqueLooksAgainstTheNormal) {
    for (const glm::dvec3& normal : {glm::dvec3(3, 2, 1), glm::dvec3(0, 1, 0), glm::dvec3(-1, 0.2, 0.5), glm::dvec3(0.1, 0, 9),
                                     glm::dvec3(0, 0, 1), glm::dvec3(0, 0, -1)}) {
        for (const Convention convention : {Convention::kRadiological, Convention::kNeurological}) {
            const model::Camera camera = fitCamera(kHead, slice(Plane::kOblique, normal), convention, 1);
            const glm::dvec3 sight = glm::normalize(camera.target_mm - camera.eye_mm);
            EXPECT_NEAR(std::abs(glm::dot(sight, glm::normalize(normal))), 1, 1e-12);
            const bool steep = std::abs(glm::normalize(normal).z) > 0.7;
            // Nearly axial planes keep the convention of axial ones; the others are seen from the side that the normal names.
            if (!steep || convention == Convention::kNeurological) {
                EXPECT_LT(glm::dot(sight, normal), 0);
            } else {
                EXPECT_GT(sight.z, 0) << "from the feet";
                EXPECT_GT(wayOf(camera, kLeft).right, 1);
            }
            EXPECT_GT(wayOf(camera, steep ? kFront : kTop).up, 1);
        }
    }
}

TEST(FitCamera, ShowsAllOfTheBoundsWithAMarginForAnyAspect) {
    for (const double aspect : {0.25, 0.8, 1.0, 16.0 / 9, 6.0}) {
        const int height = 1000, width = static_cast<int>(height * aspect);
        for (const Plane plane : {Plane::kAxial, Plane::kCoronal, Plane::kSagittal, Plane::kOblique}) {
            const model::Camera camera = fitCamera(kHead, slice(plane, {1, 2, 1}), Convention::kRadiological, aspect);
            double tightest = 1e9;
            for (int corner = 0; corner < 8; ++corner) {
                const glm::dvec3 point((corner & 1) ? kHead.maximum.x : kHead.minimum.x,
                                       (corner & 2) ? kHead.maximum.y : kHead.minimum.y,
                                       (corner & 4) ? kHead.maximum.z : kHead.minimum.z);
                const glm::dvec3 at = reference::projectPoint(camera, width, height, point);
                EXPECT_GT(at.z, 0) << "before the eye";
                tightest = std::min({tightest, at.x / width, 1 - at.x / width, at.y / height, 1 - at.y / height});
            }
            // 2 % more than the bounds: just under a hundredth on either side, to a pixel of rounding the width.
            EXPECT_NEAR(tightest, 0.01 / 1.02, 2e-3) << aspect << ' ' << static_cast<int>(plane);
        }
    }
}

TEST(FitCamera, BoundsWithoutExtentGiveAUsableCamera) {
    const model::Camera camera = fitCamera({{1, 2, 3}, {1, 2, 3}}, slice(Plane::kAxial), Convention::kRadiological, 1);
    EXPECT_NO_THROW(model::cameraFrame(camera));
    EXPECT_GT(camera.height_mm, 0);
    EXPECT_EQ(camera.target_mm, glm::dvec3(1, 2, 3));
}

}  // namespace
}  // namespace radiata::plan
