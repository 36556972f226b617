#include "reference/fxaa.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace radiata::reference {
namespace {

struct Picture {
    const std::vector<std::uint8_t>& rgba;
    int width, height;

    glm::dvec3 at(int x, int y) const {
        const auto first = static_cast<std::size_t>(4 * (std::clamp(y, 0, height - 1) * width + std::clamp(x, 0, width - 1)));
        return glm::dvec3(rgba[first], rgba[first + 1], rgba[first + 2]) / 255.0;
    }
    double brightness(int x, int y) const { return weighed(at(x, y)); }
    static double weighed(const glm::dvec3& c) { return 0.299 * c.x + 0.587 * c.y + 0.114 * c.z; }

    /// All pixels around, each by its hat function.
    glm::dvec3 between(const glm::dvec2& p) const {
        glm::dvec3 sum(0);
        for (int y = static_cast<int>(std::lround(p.y)) - 2; y <= std::lround(p.y) + 2; ++y) {
            for (int x = static_cast<int>(std::lround(p.x)) - 2; x <= std::lround(p.x) + 2; ++x) {
                sum += std::max(0.0, 1 - std::abs(p.x - x)) * std::max(0.0, 1 - std::abs(p.y - y)) * at(x, y);
            }
        }
        return sum;
    }
};

}  // namespace

glm::dvec3 fxaaPixel(const std::vector<std::uint8_t>& rgba, int width, int height, int x, int y) {
    const Picture picture{rgba, width, height};
    std::array<double, 5> around{};
    double across_rows = 0, across_columns = 0, corners = 0;
    for (int c = 0; c < 4; ++c) {
        const int dx = c % 2 * 2 - 1, dy = c / 2 * 2 - 1;
        around[static_cast<std::size_t>(c)] = picture.brightness(x + dx, y + dy);
        across_rows += dy * around[static_cast<std::size_t>(c)];
        across_columns -= dx * around[static_cast<std::size_t>(c)];
        corners += around[static_cast<std::size_t>(c)];
    }
    around[4] = picture.brightness(x, y);
    const auto [least, most] = std::ranges::minmax(around);
    if (most - least < std::max(1.0 / 24, most / 8)) return picture.at(x, y);
    const double divisor = std::min(std::abs(across_rows), std::abs(across_columns)) + std::max(corners / 32, 1.0 / 128);
    const glm::dvec2 edge = glm::clamp(glm::dvec2(across_rows, across_columns) / divisor, -8.0, 8.0), place(x, y);
    const glm::dvec3 inner = picture.between(place - edge / 6.0) + picture.between(place + edge / 6.0);
    const glm::dvec3 outer = picture.between(place - edge / 2.0) + picture.between(place + edge / 2.0);
    const glm::dvec3 wide = (inner + outer) / 4.0;
    const double brightness = Picture::weighed(wide);
    return brightness < least || brightness > most ? inner / 2.0 : wide;
}

}  // namespace radiata::reference
