// What pipelines hold, shared by gpu/*.cpp only.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "gpu/device_impl.h"
#include "gpu/graphics_pipeline.h"
#include "gpu/pipeline.h"

namespace radiata::gpu {

/// Of shaders/common/invocation.glsl: the pipeline's subgroups are full.
constexpr std::uint32_t kFullSubgroupsConstant = 63;

/// Specialisation constants of 32 bits, constants[i] with constant_id i.
struct Specialisation {
    explicit Specialisation(std::span<const std::uint32_t> constants, bool full_subgroups = false)
        : values(constants.begin(), constants.end()) {
        for (std::uint32_t i = 0; i < constants.size(); ++i) {
            entries.push_back({.constantID = i, .offset = i * 4, .size = 4});
        }
        entries.push_back(
            {.constantID = kFullSubgroupsConstant, .offset = static_cast<std::uint32_t>(constants.size_bytes()), .size = 4});
        values.push_back(full_subgroups ? 1U : 0U);
        info = {.mapEntryCount = static_cast<std::uint32_t>(entries.size()),
                .pMapEntries = entries.data(),
                .dataSize = values.size() * 4,
                .pData = values.data()};
    }
    Specialisation(const Specialisation&) = delete;
    Specialisation& operator=(const Specialisation&) = delete;

    std::vector<std::uint32_t> values;
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
