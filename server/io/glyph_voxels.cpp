#include "io/glyph_voxels.h"

#include <cmath>
#include <cstdint>
#include <limits>

#include "base/error.h"
#include "base/parallel.h"

namespace radiata::io {
namespace {

enum class VoxelKind : std::uint8_t { kEmpty, kGlyph, kRejected };

/// What each voxel is. `data`: volume by volume, voxels.size() samples each.
std::vector<VoxelKind> classify(const std::vector<float>& data, std::size_t voxel_count) {
    std::vector<VoxelKind> kinds(voxel_count, VoxelKind::kEmpty);
    parallelFor(voxel_count, 16384, [&](std::size_t begin, std::size_t end) {
        for (std::size_t first = 0; first < data.size(); first += voxel_count) {
            for (std::size_t i = begin; i < end; ++i) {
                const float value = data[first + i];
                if (!std::isfinite(value)) {
                    kinds[i] = VoxelKind::kRejected;
                } else if (value != 0 && kinds[i] == VoxelKind::kEmpty) {
                    kinds[i] = VoxelKind::kGlyph;
                }
            }
        }
    });
    return kinds;
}

}  // namespace

void setGrid(const StoredImage& stored, const std::string& file, model::ShImage& image) {
    for (int axis = 0; axis < 3; ++axis) {
        const std::int64_t length = stored.size[static_cast<std::size_t>(axis)];
        if (length > std::numeric_limits<int>::max()) {
            throw Error(Code::kResourceExhausted, file + ": axis " + std::to_string(axis + 1) + " has " +
                                                      std::to_string(length) + " voxels; at most 2147483647 are read");
        }
        image.size[axis] = static_cast<int>(length);
    }
    image.voxel_to_world = stored.voxel_to_world;
    image.source = file;
}

std::vector<std::size_t> setVoxels(const std::vector<float>& data, std::size_t voxel_count, model::ShImage& image) {
    const std::vector<VoxelKind> kinds = classify(data, voxel_count);
    std::vector<std::size_t> glyphs;
    for (std::size_t i = 0; i < voxel_count; ++i) {
        if (kinds[i] == VoxelKind::kRejected) ++image.rejected_voxels;
        if (kinds[i] != VoxelKind::kGlyph) continue;
        glyphs.push_back(i);
        const auto row = static_cast<std::size_t>(image.size.x);
        const std::size_t slice = row * static_cast<std::size_t>(image.size.y);
        image.voxels.emplace_back(static_cast<int>(i % row), static_cast<int>(i % slice / row), static_cast<int>(i / slice));
    }
    return glyphs;
}

}  // namespace radiata::io
