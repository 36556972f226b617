// What a Buffer holds and where its memory comes from, shared by gpu/*.cpp only.
#pragma once

#include "gpu/buffer.h"
#include "gpu/device_impl.h"

namespace radiata::gpu {

/// A share of a heap, given back on destruction.
class HeapShare {
public:
    HeapShare() = default;
    /// \throws Error(kResourceExhausted) if the heap or the number of allocations is used up
    HeapShare(Device::Impl& device, std::uint32_t heap, std::uint64_t size_bytes, const std::string& name);
    ~HeapShare();
    HeapShare(const HeapShare&) = delete;
    HeapShare& operator=(const HeapShare&) = delete;

private:
    Device::Impl* device_ = nullptr;
    std::uint32_t heap_ = 0;
    std::uint64_t size_bytes_ = 0;
};

/// Memory of its own for one buffer or image, counted in its heap.
struct Allocation {
    vk::raii::DeviceMemory memory{nullptr};
    std::unique_ptr<HeapShare> share;
};

/// \param name  of the buffer or image, for messages
/// \throws Error(kResourceExhausted) saying name, size and what the device has, vk::SystemError
Allocation allocate(Device::Impl& device, const vk::MemoryRequirements& needs, Memory memory, const std::string& name);

struct Buffer::Impl {
    Impl(Device::Impl& device, std::uint64_t size_bytes, Memory memory, const std::string& name);

    std::string name;
    std::uint64_t size_bytes = 0;
    Allocation allocation;
    vk::raii::Buffer buffer{nullptr};
    std::byte* mapped = nullptr;
    std::uint64_t address = 0;
};

}  // namespace radiata::gpu
