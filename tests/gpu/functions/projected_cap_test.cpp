// Directions towards a spherical light and all around a surface: densities against sums over the light in double.
#include "reference/projected_cap.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "gpu/functions/function_runner.h"
#include "shaders/test/visibility_io.glsl"

namespace radiata {
namespace {

using shader::CapInput;
using shader::CapOutput;
using ProjectedCap = test::FunctionTest;

constexpr double kRadian = std::numbers::pi / 180;

struct Case {
    double radius_deg, inclination_deg;
};

/// Whole, cut with the centre above, on and below the horizon, and out of sight; small and large lights.
std::vector<Case> cases() {
    std::vector<Case> all;
    for (const double radius : {0.05, 1.0, 5.0, 25.0, 60.0}) {
        for (const double share : {-1.01, -0.95, -0.6, -0.2, 0.0, 0.2, 0.7, 0.99, 1.3}) {
            all.push_back({radius, 90 - share * radius});
        }
        all.push_back({radius, 0});
        all.push_back({radius, 40});
    }
    return all;
}

CapInput inputOf(const Case& x, std::uint32_t index, std::uint32_t pixel) {
    const double inclination = x.inclination_deg * kRadian;
    const glm::dvec3 normal = glm::normalize(glm::dvec3(0.3, -0.5, 0.8)),
                     tangent = glm::normalize(glm::cross(normal, {1, 0, 0}));
    CapInput input{};
    input.normal = normal;
    input.light = std::cos(inclination) * normal + std::sin(inclination) * tangent;
    input.sine = static_cast<float>(std::sin(x.radius_deg * kRadian));
    input.cosine = static_cast<float>(std::cos(x.radius_deg * kRadian));
    input.index = index;
    input.pixel = pixel;
    return input;
}

double projectedSolidAngle(const Case& x) {
    const CapInput input = inputOf(x, 0, 0);
    return reference::integrateProjectedCap(glm::normalize(glm::dvec3(input.light)), glm::normalize(glm::dvec3(input.normal)),
                                            x.radius_deg * kRadian, [](const glm::dvec3&) { return 1.0; });
}

TEST_F(ProjectedCap, AreaIsTheProjectedSolidAngle) {
    std::vector<CapInput> inputs;
    for (const Case& x : cases()) inputs.push_back(inputOf(x, 0, 0));
    const auto outputs = runFunction<CapOutput>("test_projected_cap", {}, inputs);
    double worst = 0;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        const double facing = std::numbers::pi * inputs[i].sine * inputs[i].sine;
        worst = std::max(worst, std::abs(outputs[i].area - projectedSolidAngle(cases()[i])) / facing);
        EXPECT_NEAR(outputs[i].area / facing, projectedSolidAngle(cases()[i]) / facing, 5e-5)
            << cases()[i].radius_deg << " at " << cases()[i].inclination_deg;
    }
    std::printf("area: worst %.1e of the light facing the surface\n", worst);
}

/// Moments of the directions about the light's centre, in units of its radius, over 4096 rays of one pixel.
TEST_F(ProjectedCap, RaysAreSpreadByProjectedSolidAngle) {
    constexpr std::uint32_t kRays = 4096;
    double worst = 0;
    for (const Case& x : cases()) {
        const double area = projectedSolidAngle(x);
        const CapInput first = inputOf(x, 0, 7);
        if (area < 1e-4 * first.sine * first.sine) continue;
        std::vector<CapInput> inputs;
        for (std::uint32_t i = 0; i < kRays; ++i) inputs.push_back(inputOf(x, i, 7));
        const auto outputs = runFunction<CapOutput>("test_projected_cap", {}, inputs);
        const glm::dvec3 light = glm::normalize(glm::dvec3(first.light)), normal = glm::normalize(glm::dvec3(first.normal));
        const glm::dvec3 across = glm::normalize(glm::cross(normal, glm::dvec3(1, 0.2, 0.1)));
        const std::vector<std::function<double(const glm::dvec3&)>> moments = {
            [&](const glm::dvec3& d) { return glm::dot(d - light, normal) / first.sine; },
            [&](const glm::dvec3& d) { return glm::dot(d - light, across) / first.sine; },
            [&](const glm::dvec3& d) { return std::pow(glm::dot(d - light, normal) / first.sine, 2); },
            [&](const glm::dvec3& d) { return std::pow(glm::dot(d - light, across) / first.sine, 2); },
            [&](const glm::dvec3& d) {
                return glm::dot(d - light, across) * glm::dot(d - light, normal) / std::pow(first.sine, 2);
            },
        };
        for (const auto& moment : moments) {
            double mean = 0;
            for (const CapOutput& output : outputs) mean += moment(glm::dvec3(output.direction)) / kRays;
            const double expected = reference::integrateProjectedCap(light, normal, x.radius_deg * kRadian, moment) / area;
            worst = std::max(worst, std::abs(mean - expected));
            EXPECT_NEAR(mean, expected, 3e-3) << x.radius_deg << " at " << x.inclination_deg;
        }
        for (const CapOutput& output : outputs) {
            const glm::dvec3 d = output.direction;
            ASSERT_NEAR(glm::length(d), 1, 1e-5);
            ASSERT_GE(glm::dot(d, normal), -1e-6);
            // How far outside the light, in its radii: float32 has 1e-7 for a direction of length 1.
            ASSERT_LE(glm::length(d - light), 2 * std::sin(x.radius_deg * kRadian / 2) + 4e-4 * first.sine + 4e-7)
                << x.radius_deg << " at " << x.inclination_deg;
        }
    }
    std::printf("moments: worst %.1e\n", worst);
}

TEST_F(ProjectedCap, HemisphereIsSpreadByTheCosine) {
    std::vector<CapInput> inputs;
    for (std::uint32_t i = 0; i < 4096; ++i) inputs.push_back(inputOf({5, 20}, i, 3));
    const auto outputs = runFunction<CapOutput>("test_projected_cap", {}, inputs);
    const glm::dvec3 normal = inputs[0].normal;
    double mean = 0, square = 0;
    glm::dvec3 sum(0);
    for (const CapOutput& output : outputs) {
        const double cosine = glm::dot(glm::dvec3(output.hemisphere), normal);
        EXPECT_GE(cosine, 0);
        mean += cosine / 4096;
        square += cosine * cosine / 4096;
        sum += glm::dvec3(output.hemisphere) / 4096.0;
    }
    EXPECT_NEAR(mean, 2.0 / 3, 2e-3);
    EXPECT_NEAR(square, 0.5, 2e-3);
    EXPECT_LT(glm::length(sum - mean * normal), 4e-3);
}

TEST_F(ProjectedCap, PointsOfRaysAreThoseOfTheTwin) {
    std::vector<CapInput> inputs;
    for (std::uint32_t i = 0; i < 3000; ++i) inputs.push_back(inputOf({5, 20}, i * 7919, i * i));
    const auto outputs = runFunction<CapOutput>("test_projected_cap", {}, inputs);
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        const glm::dvec2 expected = reference::raySample(inputs[i].index, inputs[i].pixel);
        ASSERT_EQ(glm::dvec2(outputs[i].point), expected) << i;
        ASSERT_TRUE(expected.x >= 0 && expected.x < 1 && expected.y >= 0 && expected.y < 1);
    }
}

}  // namespace
}  // namespace radiata
