#include "tools/lab/fibre_pipelines.h"

#include <algorithm>

namespace radiata::lab {
namespace {

/// Whether a picture shows a fibre within a pixel of a place.
bool near(const std::vector<std::int32_t>& picture, int width, int x, int y, std::int32_t fibre) {
    const int height = static_cast<int>(picture.size()) / width;
    for (int j = std::max(y - 1, 0); j <= std::min(y + 1, height - 1); ++j) {
        for (int i = std::max(x - 1, 0); i <= std::min(x + 1, width - 1); ++i) {
            if (picture[static_cast<std::size_t>(j) * static_cast<std::size_t>(width) + static_cast<std::size_t>(i)] == fibre) {
                return true;
            }
        }
    }
    return false;
}

}  // namespace

FibreDifferences compareFibres(const std::vector<std::int32_t>& a, const std::vector<std::int32_t>& b, int width) {
    FibreDifferences found;
    for (std::size_t at = 0; at < a.size(); ++at) {
        if (a[at] < 0 && b[at] < 0) continue;
        ++found.shown;
        if (a[at] == b[at]) continue;
        ++found.fibre;
        found.alone += a[at] < 0 || b[at] < 0;
        const int x = static_cast<int>(at) % width, y = static_cast<int>(at) / width;
        found.far += (a[at] >= 0 && !near(b, width, x, y, a[at])) || (b[at] >= 0 && !near(a, width, x, y, b[at]));
    }
    return found;
}

std::vector<std::int32_t> fibresOf(const model::FramePixels& pixels) {
    std::vector<std::int32_t> fibres(pixels.id.size() / 4, -1);
    for (std::size_t at = 0; at < fibres.size(); ++at) {
        if (pixels.id[4 * at] >= 0) fibres[at] = pixels.id[4 * at + 1];
    }
    return fibres;
}

}  // namespace radiata::lab
