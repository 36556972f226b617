// What pipelines hold, shared by gpu/*.cpp only.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "gpu/device_impl.h"
#include "gpu/graphics_pipeline.h"
#include "gpu/pipeline.h"

namespace radiata::gpu {

/// Specialisation constants of 32 bits, constants[i] with constant_id i; `constants` must outlive it.
struct Specialisation {
    explicit Specialisation(std::span<const std::uint32_t> constants) {
        for (std::uint32_t i = 0; i < constants.size(); ++i) {
            entries.push_back({.constantID = i, .offset = i * 4, .size = 4});
        }
        info = {.mapEntryCount = static_cast<std::uint32_t>(entries.size()),
                .pMapEntries = entries.data(),
                .dataSize = constants.size_bytes(),
                .pData = constants.data()};
    }
    Specialisation(const Specialisation&) = delete;
    Specialisation& operator=(const Specialisation&) = delete;

    std::vector<vk::SpecializationMapEntry> entries;
    vk::SpecializationInfo info;
};

struct ComputePipeline::Impl {
    std::string shader_name;
    vk::raii::Pipeline pipeline{nullptr};
};

struct GraphicsPipeline::Impl {
    std::string shader_name;
    vk::raii::Pipeline pipeline{nullptr};
};

}  // namespace radiata::gpu
