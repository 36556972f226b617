// Rays through whole volumes, and gradients: the walk on the device against the sorted crossings of all grid planes in double,
// made volumes always and real ones (folder RADIATA_DATA) with what another program found there.
#include "shaders/shared/isosurface.glsl"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>

#include <glm/gtx/component_wise.hpp>

#include "build/folded_ball.h"
#include "gpu/functions/function_runner.h"
#include "gpu/functions/volume_on_device.h"
#include "reference/scalar_field.h"
#include "shaders/test/isosurface_io.glsl"

namespace radiata {
namespace {

using reference::ScalarField;
using shader::VolumeRay;
using shader::VolumeRayHit;

class VolumeFunctions : public test::FunctionTest {
protected:
    std::vector<VolumeRayHit> trace(const std::vector<VolumeRay>& rays, bool bricks = true) {
        return runFunction<VolumeRayHit>("test_volume_trace", {bricks ? 1U : 0U}, rays);
    }
};

constexpr float kMiss = 3.4e38F;

VolumeRay rayOf(const shader::VolumeParams& volume, const glm::vec3& origin, const glm::vec3& direction, float isovalue) {
    return {volume, glm::ivec3(0), origin, direction, isovalue, 0, 1e30F};
}

/// Rays from a sphere around the volume towards points in it.
std::vector<VolumeRay> raysFromOutside(const shader::VolumeParams& volume, float isovalue, std::size_t count) {
    std::mt19937 random(23);
    std::normal_distribution<float> normal;
    std::uniform_real_distribution<float> unit(0, 1);
    const glm::vec3 size = glm::vec3(volume.size) - 1.0F, middle = 0.5F * size;
    std::vector<VolumeRay> rays;
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3 from =
            glm::normalize(glm::vec3(normal(random), normal(random), normal(random))) * glm::length(size) + middle;
        const glm::vec3 to = glm::vec3(unit(random), unit(random), unit(random)) * size;
        rays.push_back(rayOf(volume, from, glm::normalize(to - from), isovalue));
    }
    return rays;
}

struct Comparison {
    int hits = 0, misses = 0, apart = 0, lost = 0, invented = 0;
    double worst = 0;
};

/// Against the reference. A ray that only touches the surface may see it or not.
Comparison compare(const ScalarField& volume, const std::vector<VolumeRay>& rays, const std::vector<VolumeRayHit>& hits,
                   double graze) {
    Comparison result;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const VolumeRay& ray = rays[i];
        const auto expected =
            volume.firstHit(glm::dvec3(ray.origin) + glm::dvec3(ray.base), ray.direction, ray.isovalue, ray.t_min, ray.t_max);
        const bool hit = hits[i].t < kMiss;
        if (expected && expected->margin < graze) continue;
        if (!expected) {
            result.misses += hit ? 0 : 1;
            result.invented += hit ? 1 : 0;
        } else if (!hit) {
            ++result.lost;
        } else {
            ++result.hits;
            const double error = std::abs(hits[i].t - expected->t);
            result.worst = std::max(result.worst, error);
            result.apart += error > 0.01 ? 1 : 0;
        }
    }
    return result;
}

TEST_F(VolumeFunctions, HitsOfAFoldedBallAreThoseOfTheReference) {
    const model::ScalarImage image = foldedBall(70);
    const test::VolumeOnDevice device(this->device(), image);
    for (const float isovalue : {30.0F, 60.0F}) {
        const std::vector<VolumeRay> rays = raysFromOutside(device.params, isovalue, 4000);
        const std::vector<VolumeRayHit> hits = trace(rays), plain = trace(rays, false);
        const Comparison found = compare(ScalarField(image), rays, hits, 1e-3);
        std::printf("isovalue %g: %d hits, %d misses, worst %.2g voxels\n", isovalue, found.hits, found.misses, found.worst);
        EXPECT_GT(found.hits, 800);
        EXPECT_EQ(found.lost, 0);
        EXPECT_EQ(found.invented, 0);
        EXPECT_EQ(found.apart, 0);
        EXPECT_LT(found.worst, 1e-3);  // along grazing rays; the value there is right to rounding, see below
        std::uint64_t steps = 0, plain_steps = 0;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            EXPECT_EQ(hits[i].t < kMiss, plain[i].t < kMiss);
            steps += hits[i].steps;
            plain_steps += plain[i].steps;
            if (!(hits[i].t < kMiss)) continue;
            EXPECT_NEAR(hits[i].t, plain[i].t, 1e-4);
            const glm::dvec3 p = glm::dvec3(hits[i].cell) + glm::dvec3(hits[i].at);
            EXPECT_NEAR(ScalarField(image).value(p), isovalue, 2e-5 * 100);
            EXPECT_LT(glm::length(p - glm::dvec3(rays[i].origin) - double(hits[i].t) * glm::dvec3(rays[i].direction)), 1e-4);
            EXPECT_EQ(hits[i].inside, 0U);
        }
        EXPECT_LT(2 * steps, plain_steps);
    }
}

TEST_F(VolumeFunctions, NoRayLeavesAClosedBall) {
    const int size = 64;
    model::ScalarImage image;
    image.size = glm::ivec3(size);
    for (int k = 0; k < size; ++k) {
        for (int j = 0; j < size; ++j) {
            for (int i = 0; i < size; ++i) image.values.push_back(28.3F - glm::length(glm::vec3(i, j, k) - 31.5F));
        }
    }
    const test::VolumeOnDevice device(this->device(), image);
    std::mt19937 random(29);
    std::normal_distribution<float> normal;
    std::uniform_real_distribution<float> place(20, 43);
    std::vector<VolumeRay> rays;
    for (int i = 0; i < 200'000; ++i) {
        const glm::vec3 d = glm::normalize(glm::vec3(normal(random), normal(random), normal(random)));
        rays.push_back(rayOf(device.params, {place(random), place(random), place(random)}, d, 0));
        // Through grid points and along grid lines, where cells meet.
        if (i % 4 == 1) rays.back().origin = glm::round(rays.back().origin);
        if (i % 4 == 2) rays.back().direction = glm::vec3(glm::ivec3(random() % 5, random() % 5, random() % 5) - 2);
        if (i % 8 == 3) rays.back().direction[static_cast<int>(random() % 3)] = 0;
        if (i % 8 == 2) rays.back().origin = glm::round(rays.back().origin);
        if (rays.back().direction == glm::vec3(0)) rays.back().direction = {0, 0, 1};
    }
    int leaks = 0;
    for (const VolumeRayHit& hit : trace(rays)) leaks += hit.t < kMiss && hit.inside == 1 ? 0 : 1;
    EXPECT_EQ(leaks, 0);
}

TEST_F(VolumeFunctions, OddRaysAndVolumesHaveTheAnswersOfTheirFormulas) {
    model::ScalarImage ramp;  // the value is x + 10 y
    ramp.size = {12, 5, 4};
    for (int n = 0; n < 12 * 5 * 4; ++n) ramp.values.push_back(static_cast<float>(n % 12 + 10 * (n / 12 % 5)));
    model::ScalarImage holed = ramp;
    holed.values[static_cast<std::size_t>(6 + 12 * (2 + 5 * 1))] = std::numeric_limits<float>::quiet_NaN();
    model::ScalarImage smallest;
    smallest.size = {2, 2, 2};
    smallest.values = {0, 1, 0, 1, 0, 1, 0, 1};
    const test::VolumeOnDevice on_ramp(device(), ramp), on_holed(device(), holed), on_smallest(device(), smallest);
    const shader::VolumeParams &a = on_ramp.params, &b = on_holed.params, &c = on_smallest.params;
    std::vector<VolumeRay> rays{
        rayOf(a, {-3, 1.5F, 1.5F}, {1, 0, 0}, 20.5F),  // x = 5.5
        rayOf(a, {-3, 2, 2}, {1, 0, 0}, 25),           // along a grid line, through a sample of that value
        rayOf(a, {-3, 4, 3}, {1, 0, 0}, 45),           // along the volume's own edge
        rayOf(a, {-3, 4.001F, 3}, {1, 0, 0}, 45),      // just past it
        rayOf(a, {20, 1.5F, 1.5F}, {-1, 0, 0}, 20.5F),
        rayOf(a, {5, 1.5F, 1.5F}, {0, 0, 1}, 20),         // within the surface
        rayOf(a, {-3, 1.5F, 1.5F}, {0.5F, 0, 0}, 20.5F),  // t counts in the direction's length
        rayOf(b, {-3, 1.5F, 1.5F}, {1, 0, 0}, 20.5F),     // into the cells that the hole has taken
        rayOf(b, {-3, 3.5F, 2.5F}, {1, 0, 0}, 40.5F),     // beside them
        rayOf(c, {-1, 0.5F, 0.5F}, {1, 0, 0}, 0.25F),
        rayOf(c, {-1, 0.5F, 0.5F}, {1, 0, 0}, 2),
    };
    VolumeRay limited = rays[0];
    limited.t_max = 8.4F;
    rays.push_back(limited);
    limited.t_max = 8.6F;
    rays.push_back(limited);
    limited.t_min = 8.55F;
    rays.push_back(limited);
    VolumeRay rebased = rays[0];
    rebased.base = {1000, -20, 3};
    rebased.origin -= glm::vec3(rebased.base);
    rays.push_back(rebased);
    const std::vector<double> expected{8.5, 8, 8, kMiss, 14.5, kMiss, 17, kMiss, 8.5, 1.25, kMiss, kMiss, 8.5, kMiss, 8.5};
    for (const bool bricks : {true, false}) {
        const std::vector<VolumeRayHit> hits = trace(rays, bricks);
        for (std::size_t i = 0; i < expected.size(); ++i)
            EXPECT_NEAR(hits[i].t, expected[i], 1e-5) << i << (bricks ? "" : " plain");
    }
}

TEST_F(VolumeFunctions, LongVolumesAreHitAtTheirFarEnd) {
    model::ScalarImage image;
    image.size = {3, 2, 60'000};
    image.values.assign(3 * 2 * 60'000, 0.0F);
    for (std::size_t n = image.values.size() - 6; n < image.values.size(); ++n) image.values[n] = 1;
    const test::VolumeOnDevice device(this->device(), image);
    const auto hits = trace({rayOf(device.params, {1, 0.5F, -5}, {0, 0, 1}, 0.5F)});
    EXPECT_NEAR(hits[0].t, 60'000 - 1.5 + 5, 0.01);
    EXPECT_EQ(hits[0].cell.z, 59'998);
    EXPECT_NEAR(hits[0].at.z, 0.5, 0.01);
}

TEST_F(VolumeFunctions, SamplesBehindTheFirstFourGibibytesAreReached) {
    // Two planes stand for those at 8 GiB of a larger volume: a ray between them reads nothing else.
    model::ScalarImage image;
    image.size = {1024, 1024, 2};
    image.values.assign(2 * 1024 * 1024, 0.0F);
    for (std::size_t n = 0; n < image.values.size(); ++n) image.values[n] = static_cast<float>(n % 1024);
    const test::VolumeOnDevice device(this->device(), image);
    shader::VolumeParams volume = device.params;
    volume.size.z = 3000;
    volume.samples -= 2000ULL * 1024 * 1024 * 4;
    const auto hits = trace({rayOf(volume, {-1, 7.5F, 2000.5F}, {1, 0, 0}, 700.25F)}, false);
    EXPECT_NEAR(hits[0].t, 701.25, 1e-3);
    EXPECT_EQ(hits[0].cell, glm::ivec3(700, 7, 2000));
}

TEST_F(VolumeFunctions, GradientsAgreeWithTheReference) {
    const model::ScalarImage image = foldedBall(24);
    const ScalarField function(image);
    const test::VolumeOnDevice device(this->device(), image);
    std::mt19937 random(31);
    std::uniform_real_distribution<float> unit(0, 1);
    std::vector<shader::GradientInput> inputs(3000);
    for (auto& x : inputs) {
        x.volume = device.params;
        x.cell = {random() % 23, random() % 23, random() % 23};
        x.at = {unit(random), unit(random), unit(random)};
    }
    inputs[0].cell = {0, 0, 0};
    inputs[0].at = {0, 0, 0};
    inputs[1].cell = {22, 22, 22};
    inputs[1].at = {1, 1, 1};
    for (std::size_t i = 2; i < 500; ++i) inputs[i].cell[static_cast<int>(i % 3)] = i % 2 == 0 ? 0 : 22;  // at the faces
    const auto outputs = runFunction<shader::GradientOutput>("test_volume_gradient", {}, inputs);
    double worst = 0;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        const glm::dvec3 p = glm::dvec3(inputs[i].cell) + glm::dvec3(inputs[i].at);
        worst = std::max(worst, glm::length(glm::dvec3(outputs[i].spline) - function.splineGradient(p)));
        if (glm::compMin(glm::min(inputs[i].at, 1.0F - inputs[i].at)) > 0) {
            worst = std::max(worst, glm::length(glm::dvec3(outputs[i].trilinear) - function.gradient(p)));
        }
        EXPECT_EQ(outputs[i].spline_world, outputs[i].spline);  // voxels of 1 mm along the axes
    }
    EXPECT_LT(worst, 5e-5);  // of values to 100
}

TEST_F(VolumeFunctions, GradientsAreTrilinearWhereTheSplineMeetsAHole) {
    model::ScalarImage image = foldedBall(12);
    image.values[static_cast<std::size_t>(3 + 12 * (3 + 12 * 3))] = std::numeric_limits<float>::quiet_NaN();
    const test::VolumeOnDevice device(this->device(), image);
    const std::vector<shader::GradientInput> inputs{{device.params, {4, 4, 4}, {0.5F, 0.5F, 0.5F}},
                                                    {device.params, {5, 5, 5}, {0.5F, 0.5F, 0.5F}}};
    const auto outputs = runFunction<shader::GradientOutput>("test_volume_gradient", {}, inputs);
    EXPECT_EQ(outputs[0].spline, outputs[0].trilinear);
    EXPECT_NE(outputs[1].spline, outputs[1].trilinear);
}

}  // namespace
}  // namespace radiata
