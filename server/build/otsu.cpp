#include "build/otsu.h"

#include <algorithm>
#include <array>

#include "build/volume_bricks.h"

namespace radiata {

float splitValue(const model::ScalarImage& image, float low, float high) {
    constexpr std::size_t kBins = 256;
    const double width = (static_cast<double>(high) - low) / kBins;
    if (!(width > 0)) return low;
    std::array<double, kBins> counts{};
    for (const float value : image.values) {
        if (!hasValue(value)) continue;
        const double bin = (static_cast<double>(value) - low) / width;
        ++counts[std::min(kBins - 1, static_cast<std::size_t>(std::max(bin, 0.0)))];
    }
    double all = 0, sum = 0;
    for (std::size_t bin = 0; bin < kBins; ++bin) {
        all += counts[bin];
        sum += counts[bin] * (static_cast<double>(bin) + 0.5);
    }
    double below = 0, sum_below = 0, best = -1;
    std::size_t split = 0;
    for (std::size_t bin = 0; bin + 1 < kBins; ++bin) {
        below += counts[bin];
        sum_below += counts[bin] * (static_cast<double>(bin) + 0.5);
        if (below == 0 || below == all) continue;
        const double difference = sum_below / below - (sum - sum_below) / (all - below);
        const double between = below * (all - below) * difference * difference;
        if (between > best) {
            best = between;
            split = bin;
        }
    }
    return std::clamp(static_cast<float>(low + width * static_cast<double>(split + 1)), low, high);
}

}  // namespace radiata
