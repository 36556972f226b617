#include "gpu/raster_target.h"

#include <string>

#include "gpu/raster_target_impl.h"

namespace radiata::gpu {
namespace {

RasterImage makeImage(Device::Impl& device, std::uint32_t width, std::uint32_t height, vk::Format format,
                      vk::ImageUsageFlags usage, vk::ImageAspectFlags aspect, const std::string& name) {
    RasterImage made;
    made.aspect = aspect;
    made.image = vk::raii::Image(device.device, vk::ImageCreateInfo{.imageType = vk::ImageType::e2D,
                                                                    .format = format,
                                                                    .extent = {width, height, 1},
                                                                    .mipLevels = 1,
                                                                    .arrayLayers = 1,
                                                                    .samples = vk::SampleCountFlagBits::e1,
                                                                    .tiling = vk::ImageTiling::eOptimal,
                                                                    .usage = usage | vk::ImageUsageFlagBits::eTransferSrc});
    device.nameObject(made.image, name);
    made.allocation = allocate(device, made.image.getMemoryRequirements(), Memory::kDevice, name);
    made.image.bindMemory(*made.allocation.memory, 0);
    made.view = vk::raii::ImageView(
        device.device, vk::ImageViewCreateInfo{.image = *made.image,
                                               .viewType = vk::ImageViewType::e2D,
                                               .format = format,
                                               .subresourceRange = {.aspectMask = aspect, .levelCount = 1, .layerCount = 1}});
    return made;
}

}  // namespace

RasterTarget::RasterTarget(Device& device, std::uint32_t width, std::uint32_t height) : impl_(std::make_unique<Impl>()) {
    Device::Impl& owner = device.impl();
    if (!owner.has(Feature::kRaster)) throw Error(Code::kUnsupported, "the device draws no triangles (feature raster)");
    const vk::PhysicalDeviceLimits& limits = owner.properties.limits;
    const std::uint32_t widest = std::min(limits.maxFramebufferWidth, limits.maxViewportDimensions[0]);
    const std::uint32_t highest = std::min(limits.maxFramebufferHeight, limits.maxViewportDimensions[1]);
    if (width < 1 || height < 1 || width > widest || height > highest) {
        throw Error(Code::kResourceExhausted, "a picture of " + std::to_string(width) + "x" + std::to_string(height) +
                                                  " pixels cannot be rasterised; this device draws 1x1 to " +
                                                  std::to_string(widest) + "x" + std::to_string(highest));
    }
    using Usage = vk::ImageUsageFlagBits;
    try {
        impl_->width = width;
        impl_->height = height;
        impl_->words = makeImage(owner, width, height, kWordFormat, Usage::eColorAttachment, vk::ImageAspectFlagBits::eColor,
                                 "raster words");
        impl_->depth = makeImage(owner, width, height, kDepthFormat, Usage::eDepthStencilAttachment,
                                 vk::ImageAspectFlagBits::eDepth, "raster depth");
    } catch (const vk::SystemError& error) {
        throw toError(error, "making a raster target of " + std::to_string(width) + "x" + std::to_string(height) + " pixels");
    }
}

RasterTarget::RasterTarget() = default;
RasterTarget::~RasterTarget() = default;
RasterTarget::RasterTarget(RasterTarget&&) noexcept = default;
RasterTarget& RasterTarget::operator=(RasterTarget&&) noexcept = default;

std::uint32_t RasterTarget::width() const { return impl_ ? impl_->width : 0; }
std::uint32_t RasterTarget::height() const { return impl_ ? impl_->height : 0; }

}  // namespace radiata::gpu
