#include "store/volume_dataset.h"

#include <algorithm>
#include <span>
#include <vector>

#include <zlib.h>

#include "base/error.h"
#include "build/otsu.h"
#include "build/volume_bricks.h"
#include "gpu/device.h"

namespace radiata::store {
namespace {

/// Samples as shaders expect them, sent in pieces: a second copy of the whole volume would be too much.
void uploadSamples(gpu::Device& device, const gpu::Buffer& target, const std::vector<float>& values) {
    constexpr std::size_t kPiece = std::size_t{1} << 22;
    std::vector<float> piece;
    for (std::size_t begin = 0; begin < values.size(); begin += kPiece) {
        const std::size_t end = std::min(values.size(), begin + kPiece);
        piece.assign(values.begin() + static_cast<std::ptrdiff_t>(begin), values.begin() + static_cast<std::ptrdiff_t>(end));
        for (float& sample : piece) {
            if (!hasValue(sample)) sample = shader::VOLUME_NO_VALUE;
        }
        gpu::upload(device, target, begin * sizeof(float), std::as_bytes(std::span(piece)));
    }
}

}  // namespace

VolumeDataset::VolumeDataset(gpu::Device& device, const model::ScalarImage& image) {
    const VolumeBricks bricks = buildVolumeBricks(image);
    value_min_ = bricks.value_min;
    value_max_ = bricks.value_max;
    grid_to_world_ = image.voxel_to_world;
    world_to_grid_ = glm::inverse(grid_to_world_);
    no_value_ = bricks.no_value;
    if (no_value_ == image.values.size()) {
        throw Error(Code::kInvalidArgument, image.source + ": none of the " + std::to_string(no_value_) +
                                                " voxels is a finite number; an isosurface needs some");
    }
    value_split_ = splitValue(image, value_min_, value_max_);
    const auto samples = std::as_bytes(std::span(image.values));
    check_ = static_cast<std::uint32_t>(crc32_z(0, reinterpret_cast<const Bytef*>(samples.data()), samples.size()));
    samples_ = gpu::Buffer(device, image.values.size() * sizeof(float), gpu::Memory::kDevice, "volume " + image.source);
    uploadSamples(device, samples_, image.values);
    const auto brick_bytes = std::as_bytes(std::span(bricks.bricks.ranges));
    const auto block_bytes = std::as_bytes(std::span(bricks.blocks.ranges));
    ranges_ = gpu::Buffer(device, brick_bytes.size() + block_bytes.size(), gpu::Memory::kDevice, "bricks of " + image.source);
    gpu::upload(device, ranges_, 0, brick_bytes);
    gpu::upload(device, ranges_, brick_bytes.size(), block_bytes);
    params_.samples = samples_.address();
    params_.bricks = ranges_.address();
    params_.blocks = ranges_.address() + brick_bytes.size();
    params_.size = image.size;
    params_.brick_size = bricks.bricks.size;
    params_.block_size = bricks.blocks.size;
    const glm::dmat3 to_world(image.voxel_to_world), to_grid = glm::inverse(to_world);
    params_.grid_x = glm::vec3(to_grid[0]);
    params_.grid_y = glm::vec3(to_grid[1]);
    params_.grid_z = glm::vec3(to_grid[2]);
    params_.voxel_mm =
        static_cast<float>(std::min({glm::length(to_world[0]), glm::length(to_world[1]), glm::length(to_world[2])}));
}

}  // namespace radiata::store
