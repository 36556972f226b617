#include "gpu/pipeline.h"

#include <vector>

#include "gpu/pipeline_impl.h"

namespace radiata::gpu {

ComputePipeline::ComputePipeline(Device& device, const Shader& shader, std::span<const std::uint32_t> constants)
    : impl_(std::make_unique<Impl>()) {
    Device::Impl& owner = device.impl();
    impl_->shader_name = shader.name;
    std::vector<vk::SpecializationMapEntry> entries;
    for (std::uint32_t i = 0; i < constants.size(); ++i) {
        entries.push_back({.constantID = i, .offset = i * 4, .size = 4});
    }
    const vk::SpecializationInfo specialisation{.mapEntryCount = static_cast<std::uint32_t>(entries.size()),
                                                .pMapEntries = entries.data(),
                                                .dataSize = constants.size_bytes(),
                                                .pData = constants.data()};
    try {
        const vk::raii::ShaderModule module(
            owner.device, vk::ShaderModuleCreateInfo{.codeSize = shader.spirv.size_bytes(), .pCode = shader.spirv.data()});
        const vk::PipelineShaderStageCreateInfo stage{.stage = vk::ShaderStageFlagBits::eCompute,
                                                      .module = *module,
                                                      .pName = "main",
                                                      .pSpecializationInfo = &specialisation};
        impl_->pipeline = vk::raii::Pipeline(owner.device, owner.pipeline_cache,
                                             vk::ComputePipelineCreateInfo{.stage = stage, .layout = *owner.pipeline_layout});
        owner.nameObject(impl_->pipeline, impl_->shader_name);
    } catch (const vk::SystemError& error) {
        throw toError(error, "making the pipeline of shader '" + impl_->shader_name + "'");
    }
}

ComputePipeline::ComputePipeline() = default;
ComputePipeline::~ComputePipeline() = default;
ComputePipeline::ComputePipeline(ComputePipeline&&) noexcept = default;
ComputePipeline& ComputePipeline::operator=(ComputePipeline&&) noexcept = default;

const std::string& ComputePipeline::shaderName() const { return impl_->shader_name; }

}  // namespace radiata::gpu
