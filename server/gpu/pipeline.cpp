#include "gpu/pipeline.h"

#include "gpu/pipeline_impl.h"

namespace radiata::gpu {

ComputePipeline::ComputePipeline(Device& device, const Shader& shader, std::span<const std::uint32_t> constants)
    : impl_(std::make_unique<Impl>()) {
    Device::Impl& owner = device.impl();
    impl_->shader_name = shader.name;
    const Specialisation specialisation(constants);
    try {
        const vk::raii::ShaderModule module(
            owner.device, vk::ShaderModuleCreateInfo{.codeSize = shader.spirv.size_bytes(), .pCode = shader.spirv.data()});
        const vk::PipelineShaderStageCreateInfo stage{.stage = vk::ShaderStageFlagBits::eCompute,
                                                      .module = *module,
                                                      .pName = "main",
                                                      .pSpecializationInfo = &specialisation.info};
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
