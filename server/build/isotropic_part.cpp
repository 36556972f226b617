#include "build/isotropic_part.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace radiata {

model::ShImage withIsotropicPart(const model::ShImage& image, std::span<const std::uint32_t> slots, double amplitude) {
    model::ShImage result;
    result.size = image.size;
    result.voxel_to_world = image.voxel_to_world;
    result.layout = image.layout;
    result.file_convention = image.file_convention;
    result.file_axes = image.file_axes;
    result.source = image.source;
    const std::size_t count = image.layout.count();
    result.voxels.reserve(slots.size());
    result.coefficients.resize(slots.size() * count);
    const double coefficient = amplitude * std::sqrt(4 * std::numbers::pi);  // of Y_0^0 = 1 / sqrt(4 pi)
    for (std::size_t i = 0; i < slots.size(); ++i) {
        result.voxels.push_back(image.voxels[slots[i]]);
        float* glyph = result.coefficients.data() + i * count;
        std::copy_n(image.coefficients.data() + slots[i] * count, count, glyph);
        glyph[0] = static_cast<float>(glyph[0] + coefficient);
    }
    return result;
}

}  // namespace radiata
