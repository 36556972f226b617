#include "gpu/pipeline.h"

#include "gpu/pipeline_impl.h"

namespace radiata::gpu {

ComputePipeline::ComputePipeline(Device& device, const Shader& shader, std::span<const std::uint32_t> constants)
    : impl_(std::make_unique<Impl>()) {
    Device::Impl& owner = device.impl();
    impl_->shader_name = shader.name;
    // Constant 0 is the workgroup's size in every compute shader.
    const bool full_subgroups = owner.has(Feature::kFullSubgroups) && !constants.empty() && constants[0] > 0 &&
                                constants[0] % owner.subgroup_size_max == 0;
    const Specialisation specialisation(constants, full_subgroups);
    try {
        const vk::raii::ShaderModule module(
            owner.device, vk::ShaderModuleCreateInfo{.codeSize = shader.spirv.size_bytes(), .pCode = shader.spirv.data()});
        using Flag = vk::PipelineShaderStageCreateFlagBits;
        const vk::PipelineShaderStageCreateInfo stage{.flags = full_subgroups ? Flag::eRequireFullSubgroups : Flag{},
                                                      .stage = vk::ShaderStageFlagBits::eCompute,
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
