// What fibres are drawn with, function by function: capsules, depths in order, directions in 32 bits, places and footprints.
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "gpu/functions/function_runner.h"
#include "math/two_floats.h"
#include "plan/camera_rays.h"
#include "plan/fiblet_view.h"
#include "reference/camera_rays.h"
#include "reference/capsule.h"
#include "shaders/test/fibre_io.glsl"

namespace radiata {
namespace {

using shader::FibreInput;
using shader::FibreOutput;
using FibreFunctions = test::FunctionTest;

constexpr double kMissed = 1e38;

glm::dvec3 randomVector(std::mt19937& random) {
    std::normal_distribution<double> normal;
    return {normal(random), normal(random), normal(random)};
}

/// Hits within 1e-4 radii along the normal, normals to 2e-3, of rays from up to 1000 radii away; none wrong where it is sure.
TEST_F(FibreFunctions, CapsulesAgreeWithTheirTwin) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> unit(0, 1);
    std::vector<FibreInput> inputs(20000);
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        FibreInput& x = inputs[i];
        x.radius = 0.1F + unit(random);
        x.start = glm::vec3(5.0 * randomVector(random));
        x.along = glm::vec3(static_cast<double>(std::pow(10.0F, 2 * unit(random) - 2)) * randomVector(random));
        if (i % 50 == 0) x.along = glm::vec3(0);
        const glm::vec3 aim = x.start + unit(random) * x.along + 1.5F * x.radius * glm::vec3(randomVector(random));
        x.direction = glm::vec3(glm::normalize(randomVector(random)));
        x.origin = aim - std::pow(10.0F, 3 * unit(random)) * x.radius * x.direction;
        x.nearest = i % 3 == 0 ? glm::length(aim - x.origin) : -std::numeric_limits<float>::max();
    }
    const auto outputs = runFunction<FibreOutput>("test_fibre", {}, inputs);
    int hits = 0, wrong = 0;
    double worst_place = 0, worst_normal = 0, worst_tube = 0;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        const FibreInput& x = inputs[i];
        const auto expected = reference::capsuleHit(x.origin, x.direction, x.start, x.along, static_cast<double>(x.radius),
                                                    static_cast<double>(x.nearest));
        if (!expected.sure) continue;
        const bool hit = static_cast<double>(outputs[i].capsule) < kMissed;
        wrong += hit != expected.hit;
        if (!hit || !expected.hit) continue;
        ++hits;
        const double off =
            (static_cast<double>(outputs[i].capsule) - expected.t) * glm::dot(glm::dvec3(x.direction), expected.normal);
        worst_place = std::max(worst_place, std::abs(off) / static_cast<double>(x.radius));
        worst_normal = std::max(worst_normal, glm::length(glm::dvec3(outputs[i].normal) - expected.normal));
        const glm::dvec3 along(x.along);
        if (!(glm::length(along) > 0)) continue;
        const glm::dvec3 axis = glm::normalize(along), normal(outputs[i].normal),
                         across = normal - glm::dot(normal, axis) * axis;
        if (glm::length(across) < 0.1) continue;
        EXPECT_LT(glm::length(glm::dvec3(outputs[i].tube_tangent) - axis), 2e-3);
        worst_tube = std::max(worst_tube, glm::length(glm::dvec3(outputs[i].tube_normal) - glm::normalize(across)));
    }
    EXPECT_GT(hits, 3000);
    EXPECT_EQ(wrong, 0);
    EXPECT_LT(worst_place, 1e-3);
    EXPECT_LT(worst_normal, 4e-3);
    EXPECT_LT(worst_tube, 2.5e-2);
}

TEST_F(FibreFunctions, DepthsKeepTheirOrderAndTheirBits) {
    std::mt19937 random(4);
    std::uniform_real_distribution<float> power(-30, 30), sign(-1, 1);
    std::vector<FibreInput> inputs(10000);
    for (FibreInput& x : inputs) x.depth = std::copysign(std::exp2(power(random)), sign(random));
    inputs[0].depth = 0;
    inputs[1].depth = std::numeric_limits<float>::infinity();
    inputs[2].depth = -inputs[1].depth;
    std::ranges::sort(inputs, {}, &FibreInput::depth);
    const auto outputs = runFunction<FibreOutput>("test_fibre", {}, inputs);
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        ASSERT_EQ(outputs[i].ordered, inputs[i].depth);
        if (i > 0 && inputs[i].depth > inputs[i - 1].depth) {
            ASSERT_GT(outputs[i].order, outputs[i - 1].order);
        }
    }
}

TEST_F(FibreFunctions, TangentsOfLinesKeepFourDigits) {
    std::mt19937 random(5);
    std::vector<FibreInput> inputs(10000);
    for (FibreInput& x : inputs) x.direction = glm::vec3(randomVector(random));
    const auto outputs = runFunction<FibreOutput>("test_fibre", {}, inputs);
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        ASSERT_LT(glm::length(outputs[i].line_tangent - glm::normalize(inputs[i].direction)), 1e-4F);
    }
}

/// Places of points to 5e-3 pixels; boxes' footprints hold every point of the box, and are no farther than two pixels from them
/// where the box is small.
TEST_F(FibreFunctions, PlacesAndFootprintsAgreeWithTheCamera) {
    std::mt19937 random(6);
    std::uniform_real_distribution<double> unit(0, 1);
    const int width = 640, height = 480;
    std::vector<FibreInput> inputs;
    std::vector<model::Camera> cameras;
    std::vector<plan::RebasedCamera> rebased;
    const plan::SceneBounds scene{{-60, -50, -40}, {60, 70, 80}};
    const glm::dvec3 origin(-70, -60, -50);
    while (inputs.size() < 4000) {
        model::Camera camera;
        camera.perspective = unit(random) < 0.5;
        camera.target_mm = 20.0 * randomVector(random);
        camera.eye_mm = camera.target_mm + (30 + 400 * unit(random)) * glm::normalize(randomVector(random));
        camera.up = randomVector(random);
        camera.height_mm = 10 + 200 * unit(random);
        const plan::RebasedCamera based = plan::rebaseCamera(camera, scene, height);
        if (!based.sees_scene) continue;
        FibreInput x{};
        x.view = plan::fibletView(based.rays, {width, height}, {{0, 0}, {width, height}}, glm::vec2(0),
                                  based.reference_mm - origin, 250);
        const glm::dvec3 place =
            scene.minimum + glm::dvec3(unit(random), unit(random), unit(random)) * (scene.maximum - scene.minimum);
        x.start = glm::vec3(place - origin);
        x.along = glm::vec3(unit(random) * randomVector(random));
        inputs.push_back(x);
        cameras.push_back(camera);
        rebased.push_back(based);
    }
    const auto outputs = runFunction<FibreOutput>("test_fibre", {}, inputs);
    int inside = 0;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        const FibreInput& x = inputs[i];
        const FibreOutput& out = outputs[i];
        const glm::dvec3 expected = reference::projectPoint(cameras[i], width, height, origin + glm::dvec3(x.start));
        if (cameras[i].perspective && expected.z < 5) continue;  // places grow without bounds towards the eye
        EXPECT_NEAR(static_cast<double>(out.column), expected.x, 5e-3 + 1e-5 * std::abs(expected.x));
        EXPECT_NEAR(static_cast<double>(out.row), expected.y, 5e-3 + 1e-5 * std::abs(expected.y));
        EXPECT_NEAR(static_cast<double>(out.eye_depth) + rebased[i].depth_offset_mm, expected.z, 1e-3);
        // Corners and random points of the box.
        for (int k = 0; k < 12; ++k) {
            const glm::dvec3 share =
                k < 8 ? glm::dvec3(k & 1, k >> 1 & 1, k >> 2 & 1) : glm::dvec3(unit(random), unit(random), unit(random));
            const glm::dvec3 p = glm::dvec3(x.start) + share * glm::dvec3(x.along);
            const glm::dvec3 at = reference::projectPoint(cameras[i], width, height, origin + p);
            const bool seen = at.x >= 0 && at.y >= 0 && at.x < width && at.y < height &&
                              at.z - rebased[i].depth_offset_mm > static_cast<double>(x.view.near_depth) + 1e-3;
            if (!seen) continue;
            ASSERT_EQ(out.seen, 1U);
            ++inside;
            EXPECT_LE(out.first_column, std::floor(at.x));
            EXPECT_GE(out.last_column, std::floor(at.x));
            EXPECT_LE(out.first_row, std::floor(at.y));
            EXPECT_GE(out.last_row, std::floor(at.y));
            EXPECT_LE(static_cast<double>(out.nearest), at.z - rebased[i].depth_offset_mm);
        }
    }
    EXPECT_GT(inside, 5000);
}

}  // namespace
}  // namespace radiata
