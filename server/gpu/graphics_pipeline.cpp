#include "gpu/graphics_pipeline.h"

#include <array>

#include "gpu/pipeline_impl.h"
#include "gpu/raster_target_impl.h"

namespace radiata::gpu {
namespace {

vk::raii::ShaderModule makeModule(const Device::Impl& device, const Shader& shader) {
    return {device.device, vk::ShaderModuleCreateInfo{.codeSize = shader.spirv.size_bytes(), .pCode = shader.spirv.data()}};
}

vk::ShaderStageFlagBits flagOf(ShaderStage stage) {
    using Flag = vk::ShaderStageFlagBits;
    switch (stage) {
        case ShaderStage::kVertex:
            return Flag::eVertex;
        case ShaderStage::kGeometry:
            return Flag::eGeometry;
        case ShaderStage::kTessellationControl:
            return Flag::eTessellationControl;
        case ShaderStage::kTessellationEvaluation:
            return Flag::eTessellationEvaluation;
        case ShaderStage::kTask:
            return Flag::eTaskEXT;
        case ShaderStage::kMesh:
            return Flag::eMeshEXT;
        case ShaderStage::kFragment:
            break;
    }
    return Flag::eFragment;
}

vk::PrimitiveTopology topologyOf(Primitives primitives) {
    switch (primitives) {
        case Primitives::kLines:
            return vk::PrimitiveTopology::eLineList;
        case Primitives::kLineStrips:
            return vk::PrimitiveTopology::eLineStrip;
        case Primitives::kPointsToLines:
            return vk::PrimitiveTopology::ePointList;
        case Primitives::kPatchesToLines:
            return vk::PrimitiveTopology::ePatchList;
        case Primitives::kTriangles:
            break;
    }
    return vk::PrimitiveTopology::eTriangleList;
}

vk::raii::Pipeline makePipeline(const Device::Impl& device, std::span<const vk::PipelineShaderStageCreateInfo> stages,
                                const Assembly& assembly) {
    const bool lines = assembly.primitives != Primitives::kTriangles;
    const vk::PipelineVertexInputStateCreateInfo no_vertex_input{};
    const vk::PipelineInputAssemblyStateCreateInfo input{.topology = topologyOf(assembly.primitives)};
    const vk::PipelineTessellationStateCreateInfo one_point{.patchControlPoints = 1};
    const vk::PipelineViewportStateCreateInfo viewport{.viewportCount = 1, .scissorCount = 1};
    const vk::PipelineRasterizationLineStateCreateInfoEXT by_pixels{.lineRasterizationMode =
                                                                        vk::LineRasterizationModeEXT::eBresenham};
    const vk::PipelineRasterizationStateCreateInfo rasterization{
        .pNext = lines ? &by_pixels : nullptr,
        .polygonMode = vk::PolygonMode::eFill,
        .cullMode = assembly.faces == Faces::kBack ? vk::CullModeFlagBits::eFront : vk::CullModeFlagBits::eNone,
        .frontFace = vk::FrontFace::eCounterClockwise,
        .lineWidth = assembly.line_width};
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
            vk::GraphicsPipelineCreateInfo{
                .pNext = &formats,
                .stageCount = static_cast<std::uint32_t>(stages.size()),
                .pStages = stages.data(),
                .pVertexInputState = &no_vertex_input,
                .pInputAssemblyState = &input,
                .pTessellationState = assembly.primitives == Primitives::kPatchesToLines ? &one_point : nullptr,
                .pViewportState = &viewport,
                .pRasterizationState = &rasterization,
                .pMultisampleState = &one_sample,
                .pDepthStencilState = &depth,
                .pColorBlendState = &blend,
                .pDynamicState = &dynamic,
                .layout = *device.pipeline_layout}};
}

}  // namespace

GraphicsPipeline::GraphicsPipeline(Device& device, std::span<const StageShader> stages,
                                   std::span<const std::uint32_t> constants, const Assembly& assembly)
    : impl_(std::make_unique<Impl>()) {
    const Device::Impl& owner = device.impl();
    impl_->shader_name = stages.back().shader.name;
    if (!owner.has(Feature::kRaster)) {
        throw Error(Code::kUnsupported, "shader '" + impl_->shader_name + "' draws; this device does not (feature raster)");
    }
    if (assembly.primitives != Primitives::kTriangles && !owner.has(Feature::kLines)) {
        throw Error(Code::kUnsupported,
                    "shader '" + impl_->shader_name + "' draws lines; this device does not (feature lines)");
    }
    const Specialisation specialisation(constants);
    try {
        std::vector<vk::raii::ShaderModule> modules;
        std::vector<vk::PipelineShaderStageCreateInfo> infos;
        for (const StageShader& each : stages) {
            modules.push_back(makeModule(owner, each.shader));
            infos.push_back({.stage = flagOf(each.stage),
                             .module = *modules.back(),
                             .pName = "main",
                             .pSpecializationInfo = &specialisation.info});
        }
        impl_->pipeline = makePipeline(owner, infos, assembly);
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
