// Light in spherical harmonics against sums over the sphere of the radiance itself.
#include "build/light_harmonics.h"

#include <cmath>
#include <functional>
#include <numbers>

#include <gtest/gtest.h>

#include "base/error.h"
#include "math/gauss_legendre.h"
#include "reference/sh_function.h"

namespace radiata {
namespace {

constexpr double kPi = std::numbers::pi;

/// Coefficient i of red radiance by a product rule over the sphere.
double projected(const std::function<double(const glm::dvec3&)>& radiance, std::size_t i, int nodes) {
    std::vector<double> one(25, 0.0);
    one[i] = 1;
    const reference::ShFunction harmonic(ShLayout{4, true}, one);
    double sum = 0;
    for (const auto& [z, weight] : gaussLegendre(nodes)) {
        for (int k = 0; k < 2 * nodes; ++k) {
            const double phi = kPi * (k + 0.5) / nodes, r = std::sqrt(1 - z * z);
            const glm::dvec3 d(r * std::cos(phi), r * std::sin(phi), z);
            sum += weight * kPi / nodes * radiance(d) * harmonic(d);
        }
    }
    return sum;
}

TEST(LightHarmonics, SkiesAreExact) {
    model::Illumination light;
    light.sky = {{0.7F, 0, 0}, {0.5F, 0, 0}, {1, 2, -1}};
    light.rotation = {2, 0.4, -0.3, 1};
    const glm::dvec3 up = lightRotation(light) * glm::normalize(light.sky.up);
    const auto found = lightHarmonics(light, nullptr, 5);
    for (std::size_t i = 0; i < 25; ++i) {
        const double expected = projected([&](const glm::dvec3& d) { return 0.7F + 0.5F * glm::dot(d, up); }, i, 12);
        EXPECT_NEAR(found[0][i], expected, 1e-12) << i;
        EXPECT_EQ(found[1][i], 0);
    }
}

TEST(LightHarmonics, DiscsAgreeWithProjection) {
    model::Illumination light;
    light.sky.radiance = {0, 0, 0};
    light.suns.push_back({{0.3, -0.5, 0.8}, 30, {0, 2, 0}});
    const glm::dvec3 towards = glm::normalize(light.suns[0].direction);
    const double radiance = 2 / (kPi * 0.25);
    const auto found = lightHarmonics(light, nullptr, 5);
    for (std::size_t i = 0; i < 25; ++i) {
        // Of 1: the rule meets the disc's edge with an error of about its spacing over the disc's radius: 2.5 %.
        const auto disc = [&](const glm::dvec3& d) { return glm::dot(d, towards) > std::cos(kPi / 6) ? radiance : 0.0; };
        EXPECT_NEAR(found[1][i], projected(disc, i, 120), 0.025) << i;
    }
    EXPECT_NEAR(found[1][0], radiance * 2 * kPi * (1 - std::cos(kPi / 6)) / std::sqrt(4 * kPi), 1e-12);
}

TEST(LightHarmonics, MapsAgreeWithTheSkyTheyShow) {
    model::EnvironmentMap map{256, 128, {}, "made"};
    const auto radiance = [](const glm::dvec3& d) { return 1 + 0.5 * d.z + 0.3 * d.x * d.y + 0.2 * d.y; };
    for (int y = 0; y < map.height; ++y) {
        for (int x = 0; x < map.width; ++x) {
            map.pixels.emplace_back(radiance(environmentDirection(map, x + 0.5, y + 0.5)));
        }
    }
    model::Illumination light;
    light.environment = model::EnvironmentLight{"made", 2};
    light.rotation = {1, 0, 0, 1};  // a quarter turn about z
    const glm::dmat3 back = glm::transpose(lightRotation(light));
    const auto found = lightHarmonics(light, &map, 5);
    for (std::size_t i = 0; i < 25; ++i) {
        const double expected = projected([&](const glm::dvec3& d) { return 2 * radiance(back * d); }, i, 12);
        EXPECT_NEAR(found[2][i], expected, 1e-3) << i;
    }
}

TEST(LightHarmonics, DirectionsOfAMapAreThoseOfTheScanner) {
    const model::EnvironmentMap map{8, 4, {}, ""};
    EXPECT_LT(glm::length(environmentDirection(map, 4, 2) - glm::dvec3(0, 1, 0)), 1e-15) << "anterior in the middle";
    EXPECT_LT(glm::length(environmentDirection(map, 6, 2) - glm::dvec3(1, 0, 0)), 1e-15) << "right to the right";
    EXPECT_LT(glm::length(environmentDirection(map, 4, 0) - glm::dvec3(0, 0, 1)), 1e-15) << "superior above";
}

TEST(LightHarmonics, RefusesWhatIsNotDistant) {
    model::Illumination light;
    light.lights.emplace_back();
    EXPECT_THROW(lightHarmonics(light, nullptr, 3), Error);
    light.lights.clear();
    light.rotation = {0, 0, 0, 0};
    EXPECT_THROW(lightHarmonics(light, nullptr, 3), Error);
}

}  // namespace
}  // namespace radiata
