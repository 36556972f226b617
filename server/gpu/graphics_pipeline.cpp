#include "gpu/graphics_pipeline.h"

#include <array>

#include "gpu/pipeline_impl.h"
#include "gpu/raster_target_impl.h"

namespace radiata::gpu {
namespace {

vk::raii::ShaderModule makeModule(const Device::Impl& device, const Shader& shader) {
    return {device.device, vk::ShaderModuleCreateInfo{.codeSize = shader.spirv.size_bytes(), .pCode = shader.spirv.data()}};
}

vk::raii::Pipeline makePipeline(const Device::Impl& device, std::span<const vk::PipelineShaderStageCreateInfo> stages,
                                Faces faces) {
    const vk::PipelineVertexInputStateCreateInfo no_vertex_input{};
    const vk::PipelineInputAssemblyStateCreateInfo triangles{.topology = vk::PrimitiveTopology::eTriangleList};
    const vk::PipelineViewportStateCreateInfo viewport{.viewportCount = 1, .scissorCount = 1};
    const vk::PipelineRasterizationStateCreateInfo rasterization{
        .polygonMode = vk::PolygonMode::eFill,
        .cullMode = faces == Faces::kBack ? vk::CullModeFlagBits::eFront : vk::CullModeFlagBits::eNone,
        .frontFace = vk::FrontFace::eCounterClockwise,
        .lineWidth = 1};
    const vk::PipelineMultisampleStateCreateInfo one_sample{.rasterizationSamples = vk::SampleCountFlagBits::e1};
    const vk::PipelineDepthStencilStateCreateInfo depth{
        .depthTestEnable = VK_TRUE, .depthWriteEnable = VK_TRUE, .depthCompareOp = vk::CompareOp::eGreater};
    using Component = vk::ColorComponentFlagBits;
    const vk::PipelineColorBlendAttachmentState all_words{.colorWriteMask =
                                                              Component::eR | Component::eG | Component::eB | Component::eA};
    const vk::PipelineColorBlendStateCreateInfo blend{.attachmentCount = 1, .pAttachments = &all_words};
    const std::array changing{vk::DynamicState::eViewport, vk::DynamicState::eScissor};
    const vk::PipelineDynamicStateCreateInfo dynamic{.dynamicStateCount = changing.size(), .pDynamicStates = changing.data()};
    const vk::PipelineRenderingCreateInfo formats{
        .colorAttachmentCount = 1, .pColorAttachmentFormats = &kWordFormat, .depthAttachmentFormat = kDepthFormat};
    return {device.device, device.pipeline_cache,
            vk::GraphicsPipelineCreateInfo{.pNext = &formats,
                                           .stageCount = static_cast<std::uint32_t>(stages.size()),
                                           .pStages = stages.data(),
                                           .pVertexInputState = &no_vertex_input,
                                           .pInputAssemblyState = &triangles,
                                           .pViewportState = &viewport,
                                           .pRasterizationState = &rasterization,
                                           .pMultisampleState = &one_sample,
                                           .pDepthStencilState = &depth,
                                           .pColorBlendState = &blend,
                                           .pDynamicState = &dynamic,
                                           .layout = *device.pipeline_layout}};
}

}  // namespace

GraphicsPipeline::GraphicsPipeline(Device& device, const Shader& vertex, const Shader& fragment,
                                   std::span<const std::uint32_t> constants, Faces faces)
    : impl_(std::make_unique<Impl>()) {
    const Device::Impl& owner = device.impl();
    impl_->shader_name = fragment.name;
    if (!owner.has(Feature::kRaster)) {
        throw Error(Code::kUnsupported, "shader '" + impl_->shader_name + "' draws; this device does not (feature raster)");
    }
    const Specialisation specialisation(constants);
    try {
        const vk::raii::ShaderModule vertex_module = makeModule(owner, vertex), fragment_module = makeModule(owner, fragment);
        const std::array stages{vk::PipelineShaderStageCreateInfo{.stage = vk::ShaderStageFlagBits::eVertex,
                                                                  .module = *vertex_module,
                                                                  .pName = "main",
                                                                  .pSpecializationInfo = &specialisation.info},
                                vk::PipelineShaderStageCreateInfo{.stage = vk::ShaderStageFlagBits::eFragment,
                                                                  .module = *fragment_module,
                                                                  .pName = "main",
                                                                  .pSpecializationInfo = &specialisation.info}};
        impl_->pipeline = makePipeline(owner, stages, faces);
        owner.nameObject(impl_->pipeline, impl_->shader_name);
    } catch (const vk::SystemError& error) {
        throw toError(error, "making the pipeline of shader '" + impl_->shader_name + "'");
    }
}

GraphicsPipeline::GraphicsPipeline() = default;
GraphicsPipeline::~GraphicsPipeline() = default;
GraphicsPipeline::GraphicsPipeline(GraphicsPipeline&&) noexcept = default;
GraphicsPipeline& GraphicsPipeline::operator=(GraphicsPipeline&&) noexcept = default;

const std::string& GraphicsPipeline::shaderName() const { return impl_->shader_name; }

}  // namespace radiata::gpu
