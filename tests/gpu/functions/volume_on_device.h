// A volume as the shaders expect it, for tests of their functions.
#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "build/volume_bricks.h"
#include "gpu/buffer.h"
#include "gpu/device.h"
#include "shaders/shared/isosurface.glsl"

namespace radiata::test {

struct VolumeOnDevice {
    VolumeOnDevice(gpu::Device& device, const model::ScalarImage& image) {
        const VolumeBricks made = buildVolumeBricks(image);
        std::vector<float> values = image.values;
        for (float& value : values) value = hasValue(value) ? value : shader::VOLUME_NO_VALUE;
        samples = sent(device, std::as_bytes(std::span(values)));
        bricks = sent(device, std::as_bytes(std::span(made.bricks.ranges)));
        blocks = sent(device, std::as_bytes(std::span(made.blocks.ranges)));
        params.samples = samples.address();
        params.bricks = bricks.address();
        params.blocks = blocks.address();
        params.size = image.size;
        params.brick_size = made.bricks.size;
        params.block_size = made.blocks.size;
        const glm::mat3 to_grid(glm::inverse(glm::dmat3(image.voxel_to_world)));
        params.grid_x = to_grid[0];
        params.grid_y = to_grid[1];
        params.grid_z = to_grid[2];
        params.voxel_mm = 1;
    }

    gpu::Buffer samples, bricks, blocks;
    shader::VolumeParams params{};

private:
    static gpu::Buffer sent(gpu::Device& device, std::span<const std::byte> bytes) {
        gpu::Buffer buffer(device, bytes.size(), gpu::Memory::kDevice, "volume");
        gpu::upload(device, buffer, 0, bytes);
        return buffer;
    }
};

}  // namespace radiata::test
