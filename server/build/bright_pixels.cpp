#include "build/bright_pixels.h"

#include <cmath>
#include <numbers>

namespace radiata {
namespace {

constexpr double kCapOfMean = 4;

double luminance(const glm::vec3& c) { return glm::dot(glm::dvec3(c), glm::dvec3(0.2126, 0.7152, 0.0722)); }

/// Vose's pairing: each entry has an even share of the weight, of its own pixel and of at most one other.
std::vector<shader::BrightPixel> aliasTable(const std::vector<std::uint32_t>& pixels, std::vector<double> weights, double sum) {
    std::vector<shader::BrightPixel> table(pixels.size());
    std::vector<std::size_t> small, large;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        weights[i] *= static_cast<double>(pixels.size()) / sum;
        table[i] = {pixels[i], pixels[i], 1};
        (weights[i] < 1 ? small : large).push_back(i);
    }
    while (!small.empty() && !large.empty()) {
        const std::size_t less = small.back(), more = large.back();
        small.pop_back();
        table[less].other = pixels[more];
        table[less].keep = static_cast<float>(weights[less]);
        weights[more] -= 1 - weights[less];
        if (weights[more] >= 1) continue;
        large.pop_back();
        small.push_back(more);
    }
    return table;
}

}  // namespace

BrightPixels brightPixels(const model::EnvironmentMap& map) {
    constexpr double kPi = std::numbers::pi;
    const auto area = [&](int y) {
        return 2 * kPi / map.width * (std::cos(kPi * y / map.height) - std::cos(kPi * (y + 1) / map.height));
    };
    const auto at = [&](int x, int y) {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width) + static_cast<std::size_t>(x);
    };
    double mean = 0;
    for (int y = 0; y < map.height; ++y) {
        for (int x = 0; x < map.width; ++x) mean += area(y) / (4 * kPi) * luminance(map.pixels[at(x, y)]);
    }
    BrightPixels bright;
    bright.cap = static_cast<float>(kCapOfMean * mean);
    std::vector<std::uint32_t> pixels;
    std::vector<double> weights;
    for (int y = 0; y < map.height; ++y) {
        for (int x = 0; x < map.width; ++x) {
            const double above = luminance(map.pixels[at(x, y)]) - static_cast<double>(bright.cap);
            if (above <= 0) continue;
            pixels.push_back(static_cast<std::uint32_t>(at(x, y)));
            weights.push_back(above * area(y));
            bright.weight += weights.back();
        }
    }
    if (!pixels.empty()) bright.table = aliasTable(pixels, std::move(weights), bright.weight);
    return bright;
}

}  // namespace radiata
