#include "build/light_harmonics.h"

#include <cmath>
#include <numbers>

#include <glm/gtc/quaternion.hpp>

#include "base/error.h"
#include "math/sh_evaluate.h"
#include "math/sh_rotation_recursive.h"

namespace radiata {
namespace {

using Coefficients = std::array<std::vector<double>, 3>;
constexpr double kPi = std::numbers::pi;
constexpr int kOrderMax = 5;

/// Adds weight * Y(direction), with a factor of its own for each band.
void addDirection(Coefficients& sum, int order, const glm::dvec3& direction, const glm::dvec3& weight,
                  const std::vector<double>& band_factor = {}) {
    std::array<double, 25> y;
    evaluateSh(ShLayout{order - 1, true}, direction, std::span(y).first(static_cast<std::size_t>(order * order)));
    for (int l = 0; l < order; ++l) {
        const double factor = band_factor.empty() ? 1 : band_factor[static_cast<std::size_t>(l)];
        for (std::size_t i = static_cast<std::size_t>(l * l); i < static_cast<std::size_t>((l + 1) * (l + 1)); ++i) {
            for (int c = 0; c < 3; ++c) sum[static_cast<std::size_t>(c)][i] += factor * weight[c] * y[i];
        }
    }
}

/// 2 pi times the integral of P_l over [cosine, 1]: how much of Y_lm a disc of radiance 1 around the pole takes.
std::vector<double> discFactors(int order, double cosine) {
    std::vector<double> legendre{1, cosine};
    for (int l = 1; l <= order; ++l) {
        legendre.push_back(
            ((2 * l + 1) * cosine * legendre[static_cast<std::size_t>(l)] - l * legendre[static_cast<std::size_t>(l - 1)]) /
            (l + 1));
    }
    std::vector<double> factors{2 * kPi * (1 - cosine)};
    for (int l = 1; l < order; ++l) {
        const auto i = static_cast<std::size_t>(l);
        factors.push_back(2 * kPi * (legendre[i - 1] - legendre[i + 1]) / (2 * l + 1));
    }
    return factors;
}

void addSky(Coefficients& sum, int order, const model::Sky& sky) {
    const double constant = std::sqrt(4 * kPi);
    for (std::size_t c = 0; c < 3; ++c) sum[c][0] += constant * sky.radiance[static_cast<int>(c)];
    // d . up is 4 pi / 3 times the sum of Y_1m(d) Y_1m(up).
    std::vector<double> only_band_1(static_cast<std::size_t>(order), 0.0);
    if (order > 1) only_band_1[1] = 4 * kPi / 3;
    addDirection(sum, order, glm::normalize(sky.up), glm::dvec3(sky.gradient), only_band_1);
}

void addPixels(Coefficients& sum, int order, const model::EnvironmentMap& map) {
    for (int y = 0; y < map.height; ++y) {
        const double top = kPi * y / map.height, bottom = kPi * (y + 1) / map.height;
        const double area = 2 * kPi / map.width * (std::cos(top) - std::cos(bottom));
        for (int x = 0; x < map.width; ++x) {
            const glm::vec3& pixel =
                map.pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width) + static_cast<std::size_t>(x)];
            addDirection(sum, order, environmentDirection(map, x + 0.5, y + 0.5), area * glm::dvec3(pixel));
        }
    }
}

void addMap(Coefficients& sum, const model::EnvironmentMap& map, double scale) {
    const Coefficients& known = map.harmonics[0].empty() ? environmentHarmonics(map) : map.harmonics;
    for (std::size_t c = 0; c < 3; ++c) {
        for (std::size_t i = 0; i < sum[c].size(); ++i) sum[c][i] += scale * known[c][i];
    }
}

}  // namespace

Coefficients environmentHarmonics(const model::EnvironmentMap& map) {
    Coefficients sum;
    for (auto& channel : sum) channel.assign(static_cast<std::size_t>(kOrderMax * kOrderMax), 0.0);
    addPixels(sum, kOrderMax, map);
    return sum;
}

glm::dvec3 environmentDirection(const model::EnvironmentMap& map, double x, double y) {
    const double turn = 2 * kPi * (x / map.width - 0.5), down = kPi * y / map.height;
    return {std::sin(turn) * std::sin(down), std::cos(turn) * std::sin(down), std::cos(down)};
}

glm::dmat3 lightRotation(const model::Illumination& light) {
    const glm::dquat q(light.rotation[0], light.rotation[1], light.rotation[2], light.rotation[3]);
    const double length = glm::length(q);
    if (!(length > 0 && std::isfinite(length))) {
        throw Error(Code::kInvalidArgument, "rotation of the light: a quaternion of length " + std::to_string(length) +
                                                "; any other length than 0 turns");
    }
    return glm::mat3_cast(q / length);
}

Coefficients lightHarmonics(const model::Illumination& light, const model::EnvironmentMap* map, int order) {
    if (!light.lights.empty()) {
        throw Error(Code::kInvalidArgument, std::to_string(light.lights.size()) +
                                                " lights stand in the scene; texels with transfer know distant light only. "
                                                "Choose irradiance, or suns in place of lights");
    }
    Coefficients sum;
    for (auto& channel : sum) channel.assign(static_cast<std::size_t>(order * order), 0.0);
    if (map != nullptr && light.environment) {
        addMap(sum, *map, double{light.environment->scale});
    } else {
        addSky(sum, order, light.sky);
    }
    for (const model::SunDisc& sun : light.suns) {
        const double angle = sun.angular_radius_deg * kPi / 180, sine = std::sin(angle);
        const glm::dvec3 radiance = glm::dvec3(sun.irradiance) / (kPi * sine * sine);
        addDirection(sum, order, glm::normalize(sun.direction), radiance, discFactors(order, std::cos(angle)));
    }
    const BandMatrices turn = ivanicRuedenberg(order - 1, lightRotation(light));
    for (auto& channel : sum) applyBands(turn, channel);
    return sum;
}

}  // namespace radiata
