#include "render/frame/target.h"

#include <algorithm>

#include "render/frame/fiblet_buffers.h"
#include "render/frame/fiblet_line_buffers.h"
#include "render/frame/raster_buffers.h"

namespace radiata::render {

Target::Impl::Impl() = default;
Target::Impl::~Impl() = default;

Target::Target() : impl_(std::make_unique<Impl>()) {}
Target::~Target() = default;
Target::Target(Target&&) noexcept = default;
Target& Target::operator=(Target&&) noexcept = default;

void Target::forget() {
    auto next = std::make_unique<Impl>();
    if (impl_->width * impl_->height <= kKeptPixels) {
        next->width = impl_->width;
        next->height = impl_->height;
        next->surface = std::move(impl_->surface);
        next->picture = std::move(impl_->picture);
        if (!impl_->fiblets.empty() && impl_->fiblets[0]) {
            FibletBuffers& kept = *next->fiblets.emplace_back(std::make_unique<FibletBuffers>());
            kept.words = std::move(impl_->fiblets[0]->words);
            kept.tangents = std::move(impl_->fiblets[0]->tangents);
        }
    }
    impl_ = std::move(next);
}

void ensureBytes(gpu::Device& device, gpu::Buffer& buffer, std::uint64_t bytes, gpu::Memory memory, const char* name) {
    if (buffer && buffer.sizeBytes() >= bytes) return;
    buffer = gpu::Buffer();  // first free, then take
    buffer = gpu::Buffer(device, std::max<std::uint64_t>(bytes + bytes / 4, 256), memory, name);
}

void Target::Impl::prepare(gpu::Device& device, int new_width, int new_height, std::size_t layer_count) {
    layers.resize(std::max(layers.size(), layer_count));
    if (!params) params = gpu::Buffer(device, kParamBytes, gpu::Memory::kUpload, "frame parameters");
    if (new_width == width && new_height == height) return;
    width = height = samples = 0;
    const auto pixels = static_cast<std::uint64_t>(new_width) * static_cast<std::uint64_t>(new_height);
    for (gpu::Buffer* buffer : {&surface, &light, &picture, &surface_readback, &veil, &peel_surface, &fxaa_source})
        *buffer = gpu::Buffer();
    surface = gpu::Buffer(device, pixels * sizeof(shader::Surface), gpu::Memory::kDevice, "surface buffer");
    picture = gpu::Buffer(device, pixels * 4, gpu::Memory::kReadback, "picture");
    width = new_width;
    height = new_height;
}

}  // namespace radiata::render
