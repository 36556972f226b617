#include "render/frame/fiblet_line_buffers.h"

#include "gpu/device.h"

namespace radiata::render {

void FibletLineBuffers::prepare(gpu::Device& device, std::uint32_t width, std::uint32_t height,
                                model::FibletPipeline pipeline) {
    const std::uint64_t pixels = std::uint64_t{width} * height;
    if (model::drawsByRasteriser(pipeline) && (!images || images.width() != width || images.height() != height)) {
        images = gpu::RasterTarget();
        images = gpu::RasterTarget(device, width, height);
        words = gpu::Buffer(device, pixels * gpu::RasterTarget::kWordBytesPerPixel, gpu::Memory::kDevice, "drawn fibres");
        depth = gpu::Buffer(device, pixels * gpu::RasterTarget::kDepthBytesPerPixel, gpu::Memory::kDevice, "depth of fibres");
    }
    if (pipeline != model::FibletPipeline::kPull) {
        slots = gpu::Buffer();
        command = gpu::Buffer();
    } else if (!slots) {
        slots = gpu::Buffer(device, kSlots * sizeof(shader::FibletSlot), gpu::Memory::kDevice, "decoded fiblets");
        command = gpu::Buffer(device, 16, gpu::Memory::kDevice, "draw of fiblets");
    }
}

}  // namespace radiata::render
