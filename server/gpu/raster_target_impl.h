// What a RasterTarget holds, shared by gpu/*.cpp only.
#pragma once

#include "gpu/buffer_impl.h"
#include "gpu/raster_target.h"

namespace radiata::gpu {

// Every device with graphics can draw into these two (Vulkan 1.3, "Required Format Support").
constexpr vk::Format kWordFormat = vk::Format::eR32G32B32A32Uint, kDepthFormat = vk::Format::eD32Sfloat;

struct RasterImage {
    Allocation allocation;
    vk::raii::Image image{nullptr};
    vk::raii::ImageView view{nullptr};
    vk::ImageAspectFlags aspect;
};

struct RasterTarget::Impl {
    std::uint32_t width = 0, height = 0;
    RasterImage words, depth;
    bool drawable = false;  ///< as recorded last: laid out for drawing, else for copying
};

}  // namespace radiata::gpu
