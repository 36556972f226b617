#include "io/sh_write.h"

#include <algorithm>
#include <optional>

#include "base/checked.h"
#include "base/parallel.h"
#include "math/polar.h"
#include "math/sh_rotation.h"

namespace radiata::io {

Volume shVolume(const model::ShImage& image, ShConvention convention, ShAxes axes) {
    Volume volume;
    const std::size_t count = image.layout.count();
    volume.size = {image.size.x, image.size.y, image.size.z, static_cast<std::int64_t>(count)};
    volume.voxel_to_world = image.voxel_to_world;
    volume.source = image.source;
    const auto width = static_cast<std::size_t>(image.size.x), height = static_cast<std::size_t>(image.size.y);
    const std::size_t slice = checkedMultiply(width, height, image.source);
    const std::size_t voxels = checkedMultiply(slice, static_cast<std::size_t>(image.size.z), image.source);
    volume.data.assign(checkedMultiply(voxels, count, image.source), 0.0F);
    std::optional<ShRotation> to_voxel;
    if (axes == ShAxes::kVoxel) {
        to_voxel.emplace(image.layout, glm::transpose(orthogonalPolarFactor(glm::dmat3(image.voxel_to_world))));
    }
    parallelFor(image.voxels.size(), 1024, [&](std::size_t begin, std::size_t end) {
        std::vector<double> coefficients(count);
        for (std::size_t v = begin; v < end; ++v) {
            std::copy_n(image.coefficients.begin() + static_cast<std::ptrdiff_t>(v * count), count, coefficients.begin());
            if (to_voxel) to_voxel->apply(coefficients);
            convertSh(std::span<double>(coefficients), image.layout, ShConvention::kDescoteaux07, convention);
            const glm::ivec3& p = image.voxels[v];
            const std::size_t at =
                static_cast<std::size_t>(p.z) * slice + static_cast<std::size_t>(p.y) * width + static_cast<std::size_t>(p.x);
            for (std::size_t c = 0; c < count; ++c) volume.data[c * voxels + at] = static_cast<float>(coefficients[c]);
        }
    });
    return volume;
}

}  // namespace radiata::io
