// Drawing: the part of the recorder that knows images, their layouts and rendering scopes.
#include <array>
#include <string>

#include "gpu/pipeline_impl.h"
#include "gpu/raster_target_impl.h"
#include "gpu/recorder_impl.h"

namespace radiata::gpu {
namespace {

using Stage = vk::PipelineStageFlagBits2;
using Access = vk::AccessFlagBits2;
using Layout = vk::ImageLayout;

void moveLayouts(const vk::raii::CommandBuffer& commands, const RasterTarget::Impl& target, Layout from, Layout to) {
    auto change = [&](const RasterImage& image) {
        return vk::ImageMemoryBarrier2{.srcStageMask = Stage::eAllCommands,
                                       .srcAccessMask = Access::eMemoryWrite,
                                       .dstStageMask = Stage::eAllCommands,
                                       .dstAccessMask = Access::eMemoryRead | Access::eMemoryWrite,
                                       .oldLayout = from,
                                       .newLayout = to,
                                       .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                       .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                       .image = *image.image,
                                       .subresourceRange = {.aspectMask = image.aspect, .levelCount = 1, .layerCount = 1}};
    };
    const std::array changes{change(target.words), change(target.depth)};
    commands.pipelineBarrier2(
        vk::DependencyInfo{.imageMemoryBarrierCount = changes.size(), .pImageMemoryBarriers = changes.data()});
}

void beginRendering(const vk::raii::CommandBuffer& commands, const RasterTarget::Impl& target, vk::AttachmentLoadOp load) {
    auto attachment = [&](const RasterImage& image) {
        return vk::RenderingAttachmentInfo{.imageView = *image.view,
                                           .imageLayout = Layout::eAttachmentOptimal,
                                           .loadOp = load,
                                           .storeOp = vk::AttachmentStoreOp::eStore};  // clear values: all zero
    };
    const vk::RenderingAttachmentInfo words = attachment(target.words), depth = attachment(target.depth);
    commands.beginRendering(vk::RenderingInfo{.renderArea = {.extent = {target.width, target.height}},
                                              .layerCount = 1,
                                              .colorAttachmentCount = 1,
                                              .pColorAttachments = &words,
                                              .pDepthAttachment = &depth});
}

}  // namespace

void CommandRecorder::clear(RasterTarget& target) {
    try {
        impl_->begin();
        barrierBeforeWork(impl_->commands);
        moveLayouts(impl_->commands, target.impl(), Layout::eUndefined, Layout::eAttachmentOptimal);
        target.impl().drawable = true;
        beginRendering(impl_->commands, target.impl(), vk::AttachmentLoadOp::eClear);
        impl_->commands.endRendering();
    } catch (const vk::SystemError& error) {
        throw toError(error, "recording the clearing of a raster target");
    }
}

void CommandRecorder::drawBytes(const GraphicsPipeline& pipeline, const std::string& pass, RasterTarget& target,
                                const DrawRange& range, const void* push, std::size_t push_size) {
    if (range.index_count == 0 || range.instances == 0 || range.rows == 0) return;
    RasterTarget::Impl& into = target.impl();
    if (!into.drawable) throw Error(Code::kInternal, "pass '" + pass + "' draws into a raster target that was not cleared");
    checkRange(*range.indices, 0, std::uint64_t{range.index_count} * 4, "drawing with indices");
    try {
        const std::uint32_t query = impl_->startPass(push, push_size);
        const vk::raii::CommandBuffer& commands = impl_->commands;
        beginRendering(commands, into, vk::AttachmentLoadOp::eLoad);
        commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *pipeline.impl().pipeline);
        commands.setViewport(0, vk::Viewport{.width = static_cast<float>(into.width),
                                             .height = static_cast<float>(into.height),
                                             .minDepth = 0,
                                             .maxDepth = 1});
        commands.setScissor(
            0, vk::Rect2D{.offset = {0, static_cast<std::int32_t>(range.first_row)}, .extent = {into.width, range.rows}});
        commands.bindIndexBuffer(*range.indices->impl().buffer, 0, vk::IndexType::eUint32);
        commands.drawIndexed(range.index_count, range.instances, 0, 0, range.first_instance);
        commands.endRendering();
        impl_->endPass(query, pass, pipeline.shaderName());
    } catch (const vk::SystemError& error) {
        throw toError(error, "recording pass '" + pass + "'");
    }
}

void CommandRecorder::drawLineBytes(const GraphicsPipeline& pipeline, const std::string& pass, RasterTarget& target,
                                    const LineDraw& what, const void* push, std::size_t push_size) {
    RasterTarget::Impl& into = target.impl();
    if (!into.drawable) throw Error(Code::kInternal, "pass '" + pass + "' draws into a raster target that was not cleared");
    const auto* indirect = std::get_if<IndirectDraw>(&what);
    if (indirect) {
        checkRange(*indirect->commands, indirect->offset_bytes, std::uint64_t{indirect->count} * sizeof(VkDrawIndirectCommand),
                   "drawing from");
    }
    try {
        const std::uint32_t query = impl_->startPass(push, push_size);
        const vk::raii::CommandBuffer& commands = impl_->commands;
        beginRendering(commands, into, vk::AttachmentLoadOp::eLoad);
        commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *pipeline.impl().pipeline);
        const auto frame = static_cast<float>(impl_->device.info.line_frame_px);
        commands.setViewport(0, vk::Viewport{.x = 0.5F * (static_cast<float>(into.width) - frame),
                                             .y = 0.5F * (static_cast<float>(into.height) - frame),
                                             .width = frame,
                                             .height = frame,
                                             .minDepth = 0,
                                             .maxDepth = 1});
        commands.setScissor(0, vk::Rect2D{.extent = {into.width, into.height}});
        if (const auto* vertices = std::get_if<VertexDraw>(&what)) {
            commands.draw(vertices->vertices, vertices->instances, vertices->first_vertex, vertices->first_instance);
        } else if (indirect) {
            commands.drawIndirect(*indirect->commands->impl().buffer, indirect->offset_bytes, indirect->count,
                                  sizeof(VkDrawIndirectCommand));
        } else {
            commands.drawMeshTasksEXT(std::get<MeshDraw>(what).groups, 1, 1);
        }
        commands.endRendering();
        impl_->endPass(query, pass, pipeline.shaderName());
    } catch (const vk::SystemError& error) {
        throw toError(error, "recording pass '" + pass + "'");
    }
}

void CommandRecorder::resume(RasterTarget& target) {
    if (target.impl().drawable) return;
    try {
        impl_->begin();
        barrierBeforeWork(impl_->commands);
        moveLayouts(impl_->commands, target.impl(), Layout::eTransferSrcOptimal, Layout::eAttachmentOptimal);
        target.impl().drawable = true;
    } catch (const vk::SystemError& error) {
        throw toError(error, "recording that drawing goes on");
    }
}

void CommandRecorder::copy(RasterTarget& source, const Buffer& words, const Buffer& depth) {
    RasterTarget::Impl& from = source.impl();
    if (!from.drawable) throw Error(Code::kInternal, "copying from a raster target that was not cleared");
    const std::uint64_t pixels = std::uint64_t{from.width} * from.height;
    checkRange(words, 0, pixels * RasterTarget::kWordBytesPerPixel, "copying raster words");
    checkRange(depth, 0, pixels * RasterTarget::kDepthBytesPerPixel, "copying raster depth");
    try {
        impl_->begin();
        barrierBeforeWork(impl_->commands);
        moveLayouts(impl_->commands, from, Layout::eAttachmentOptimal, Layout::eTransferSrcOptimal);
        from.drawable = false;
        for (const auto& [image, buffer] : {std::pair(&from.words, &words), std::pair(&from.depth, &depth)}) {
            impl_->commands.copyImageToBuffer(
                *image->image, Layout::eTransferSrcOptimal, *buffer->impl().buffer,
                vk::BufferImageCopy{.imageSubresource = {.aspectMask = image->aspect, .layerCount = 1},
                                    .imageExtent = {from.width, from.height, 1}});
        }
    } catch (const vk::SystemError& error) {
        throw toError(error, "recording a copy from a raster target");
    }
}

}  // namespace radiata::gpu
