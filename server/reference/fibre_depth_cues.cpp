#include "reference/fibre_depth_cues.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace radiata::reference {
namespace {

double depthAt(std::span<const float> depth, int width, int height, int x, int y) {
    const auto row = static_cast<std::size_t>(std::clamp(y, 0, height - 1)),
               column = static_cast<std::size_t>(std::clamp(x, 0, width - 1));
    return static_cast<double>(depth[row * static_cast<std::size_t>(width) + column]);
}

}  // namespace

bool inHalo(std::span<const float> depth, int width, int height, int x, int y, double width_px, double size_mm) {
    const double own = depthAt(depth, width, height, x, y), gap = 2 * width_px * size_mm;
    const int reach = static_cast<int>(std::ceil(width_px));
    for (int other_y = y - reach; other_y <= y + reach; ++other_y) {
        for (int other_x = x - reach; other_x <= x + reach; ++other_x) {
            const double away = std::hypot(other_x - x, other_y - y);
            const double ahead = own - depthAt(depth, width, height, other_x, other_y);
            // ahead >= gap + 4 gap away / width, solved for what the nearer one needs.
            if (away > 0 && away <= width_px && ahead >= gap * (1 + 4 * away / width_px)) return true;
        }
    }
    return false;
}

double openness(std::span<const float> depth, int width, int height, int x, int y, double radius_px, double size_mm) {
    const double own = depthAt(depth, width, height, x, y), scale = radius_px * size_mm;
    constexpr int kRings = 40, kSpokes = 120;
    double sum = 0;
    for (int ring = 0; ring < kRings; ++ring) {
        const double radius = radius_px * std::sqrt((ring + 0.5) / kRings);
        for (int spoke = 0; spoke < kSpokes; ++spoke) {
            const double angle = 6.283185307179586 * (spoke + 0.5) / kSpokes;
            const int at_x = static_cast<int>(std::lround(x + radius * std::cos(angle)));
            const int at_y = static_cast<int>(std::lround(y + radius * std::sin(angle)));
            const double ahead = own - depthAt(depth, width, height, at_x, at_y);
            if (ahead <= 0) continue;
            const double far = ahead / (8 * scale);
            sum += std::min(ahead / scale, 1.0) / (1 + far * far);
        }
    }
    return 1 - 0.9 * sum / (kRings * kSpokes);
}

}  // namespace radiata::reference
