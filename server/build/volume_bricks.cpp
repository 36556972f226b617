#include "build/volume_bricks.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/parallel.h"
#include "shaders/shared/isosurface.glsl"

namespace radiata {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

glm::vec2 united(const glm::vec2& a, const glm::vec2& b) { return {std::min(a.x, b.x), std::max(a.y, b.y)}; }

/// Range of the samples [low, high], ends included.
glm::vec2 rangeOf(const model::ScalarImage& image, const glm::ivec3& low, const glm::ivec3& high) {
    glm::vec2 range(kInfinity, -kInfinity);
    for (int k = low.z; k <= high.z; ++k) {
        for (int j = low.y; j <= high.y; ++j) {
            const auto row =
                static_cast<std::size_t>(image.size.x) *
                (static_cast<std::size_t>(j) + static_cast<std::size_t>(image.size.y) * static_cast<std::size_t>(k));
            for (int i = low.x; i <= high.x; ++i) {
                const float sample = image.values[row + static_cast<std::size_t>(i)];
                if (hasValue(sample)) range = united(range, glm::vec2(sample));
            }
        }
    }
    return range;
}

std::size_t indexIn(const glm::ivec3& size, const glm::ivec3& at) {
    return static_cast<std::size_t>(at.x) +
           static_cast<std::size_t>(size.x) *
               (static_cast<std::size_t>(at.y) + static_cast<std::size_t>(size.y) * static_cast<std::size_t>(at.z));
}

template <typename Body>
void forEachBox(const glm::ivec3& size, const Body& body) {
    parallelFor(static_cast<std::size_t>(size.z), 1, [&](std::size_t begin, std::size_t end) {
        for (auto k = static_cast<int>(begin); k < static_cast<int>(end); ++k) {
            for (int j = 0; j < size.y; ++j) {
                for (int i = 0; i < size.x; ++i) body(glm::ivec3(i, j, k));
            }
        }
    });
}

BrickLevel emptyLevel(const glm::ivec3& cells, std::uint32_t shift) {
    BrickLevel level;
    level.size = (cells + ((1 << shift) - 1)) >> static_cast<int>(shift);
    level.ranges.resize(static_cast<std::size_t>(level.size.x) * static_cast<std::size_t>(level.size.y) *
                        static_cast<std::size_t>(level.size.z));
    return level;
}

}  // namespace

bool hasValue(float sample) { return std::abs(sample) < shader::VOLUME_NO_VALUE; }

VolumeBricks buildVolumeBricks(const model::ScalarImage& image) {
    if (image.size.x < 2 || image.size.y < 2 || image.size.z < 2) {
        throw Error(Code::kInvalidArgument, image.source + ": the volume has " + std::to_string(image.size.x) + " x " +
                                                std::to_string(image.size.y) + " x " + std::to_string(image.size.z) +
                                                " voxels; an isosurface needs at least 2 along each axis");
    }
    const glm::ivec3 cells = image.size - 1;
    VolumeBricks result;
    result.bricks = emptyLevel(cells, shader::BRICK_SHIFT);
    result.blocks = emptyLevel(cells, shader::BLOCK_SHIFT);
    forEachBox(result.bricks.size, [&](const glm::ivec3& brick) {
        const glm::ivec3 low = brick << static_cast<int>(shader::BRICK_SHIFT);
        const glm::ivec3 high = glm::min(low + (1 << shader::BRICK_SHIFT), cells);
        result.bricks.ranges[indexIn(result.bricks.size, brick)] = rangeOf(image, low, high);
    });
    constexpr int kStep = 1 << (shader::BLOCK_SHIFT - shader::BRICK_SHIFT);
    forEachBox(result.blocks.size, [&](const glm::ivec3& block) {
        glm::vec2 range(kInfinity, -kInfinity);
        const glm::ivec3 low = block * kStep, high = glm::min(low + kStep, result.bricks.size);
        for (int k = low.z; k < high.z; ++k) {
            for (int j = low.y; j < high.y; ++j) {
                for (int i = low.x; i < high.x; ++i) {
                    range = united(range, result.bricks.ranges[indexIn(result.bricks.size, {i, j, k})]);
                }
            }
        }
        result.blocks.ranges[indexIn(result.blocks.size, block)] = range;
    });
    glm::vec2 all(kInfinity, -kInfinity);
    for (const glm::vec2& range : result.blocks.ranges) all = united(all, range);
    if (all.x <= all.y) {
        result.value_min = all.x;
        result.value_max = all.y;
    }
    result.no_value = static_cast<std::uint64_t>(
        std::count_if(image.values.begin(), image.values.end(), [](float sample) { return !hasValue(sample); }));
    return result;
}

}  // namespace radiata
