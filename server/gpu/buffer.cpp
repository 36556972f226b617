// Buffers are few, large and long-lived, so each has an allocation of its own. What does not fit is refused before the driver
// is asked: a software device would else take all memory of the machine.
#include "gpu/buffer.h"

#include <algorithm>
#include <cstring>
#include <optional>

#include "gpu/buffer_impl.h"
#include "gpu/recorder.h"

namespace radiata::gpu {
namespace {

using Property = vk::MemoryPropertyFlagBits;
constexpr std::uint64_t kStagingBytes = 16ULL << 20;

struct Wish {
    vk::MemoryPropertyFlags needed;
    vk::MemoryPropertyFlags liked;
    vk::MemoryPropertyFlags disliked;
};

Wish wishFor(Memory memory) {
    switch (memory) {
        case Memory::kDevice:
            return {Property::eDeviceLocal, {}, Property::eHostVisible};
        case Memory::kUpload:
            return {Property::eHostVisible | Property::eHostCoherent, {}, Property::eDeviceLocal | Property::eHostCached};
        case Memory::kReadback:
            return {Property::eHostVisible | Property::eHostCoherent, Property::eHostCached, Property::eDeviceLocal};
    }
    throw Error(Code::kInternal, "unknown kind of memory");
}

std::uint32_t chooseMemoryType(const vk::PhysicalDeviceMemoryProperties& types, std::uint32_t allowed, Memory memory,
                               const std::string& name) {
    const Wish wish = wishFor(memory);
    std::optional<std::uint32_t> best;
    int best_score = -1;
    for (std::uint32_t i = 0; i < types.memoryTypeCount; ++i) {
        const vk::MemoryPropertyFlags flags = types.memoryTypes[i].propertyFlags;
        if ((allowed >> i & 1) == 0 || (flags & wish.needed) != wish.needed) continue;
        const int score = ((flags & wish.liked) == wish.liked ? 2 : 0) + (flags & wish.disliked ? 0 : 1);
        if (score > best_score) {
            best_score = score;
            best = i;
        }
    }
    if (!best) throw Error(Code::kUnsupported, "'" + name + "': the device has no memory of the kind it needs");
    return *best;
}

[[noreturn]] void tooLarge(const std::string& name, std::uint64_t size, const char* limit_name, std::uint64_t limit) {
    throw Error(Code::kResourceExhausted,
                "'" + name + "' needs " + std::to_string(size) + " bytes, " + limit_name + " " + std::to_string(limit));
}

vk::BufferUsageFlags usages(const Device::Impl& device) {
    using Usage = vk::BufferUsageFlagBits;
    vk::BufferUsageFlags flags = Usage::eShaderDeviceAddress | Usage::eStorageBuffer | Usage::eIndexBuffer |
                                 Usage::eIndirectBuffer | Usage::eTransferSrc | Usage::eTransferDst;
    if (device.has(Feature::kRayQuery)) {
        flags |= Usage::eAccelerationStructureBuildInputReadOnlyKHR | Usage::eAccelerationStructureStorageKHR;
    }
    return flags;
}

}  // namespace

HeapShare::HeapShare(Device::Impl& device, std::uint32_t heap, std::uint64_t size_bytes, const std::string& name) {
    std::uint64_t limit = device.memory.memoryHeaps[heap].size;
    const std::uint64_t taken = device.heap_bytes[heap].load();
    if (device.has(Feature::kMemoryBudget)) {
        const auto budget =
            device.physical
                .getMemoryProperties2<vk::PhysicalDeviceMemoryProperties2, vk::PhysicalDeviceMemoryBudgetPropertiesEXT>()
                .get<vk::PhysicalDeviceMemoryBudgetPropertiesEXT>();
        // Usage counts all of this process, ours included; what others left of the budget is what may be added.
        const std::uint64_t free = budget.heapBudget[heap] - std::min(budget.heapUsage[heap], budget.heapBudget[heap]);
        limit = std::min(limit, taken + free);
    }
    if (device.heap_bytes[heap].fetch_add(size_bytes) + size_bytes > limit) {
        device.heap_bytes[heap] -= size_bytes;
        tooLarge(name, size_bytes, "but this memory heap has left", limit - std::min(limit, taken));
    }
    if (device.allocation_count.fetch_add(1) >= device.properties.limits.maxMemoryAllocationCount) {
        device.allocation_count -= 1;
        device.heap_bytes[heap] -= size_bytes;
        tooLarge(name, size_bytes,
                 "but the device's number of allocations is used up:", device.properties.limits.maxMemoryAllocationCount);
    }
    device_ = &device;
    heap_ = heap;
    size_bytes_ = size_bytes;
}

HeapShare::~HeapShare() {
    if (device_ == nullptr) return;
    device_->heap_bytes[heap_] -= size_bytes_;
    device_->allocation_count -= 1;
}

Allocation allocate(Device::Impl& device, const vk::MemoryRequirements& needs, Memory memory, const std::string& name) {
    if (needs.size > device.allocation_size_max) {
        tooLarge(name, needs.size, "the device's largest allocation has", device.allocation_size_max);
    }
    const std::uint32_t type = chooseMemoryType(device.memory, needs.memoryTypeBits, memory, name);
    Allocation allocation;
    allocation.share = std::make_unique<HeapShare>(device, device.memory.memoryTypes[type].heapIndex, needs.size, name);
    const vk::MemoryAllocateFlagsInfo flags{.flags = vk::MemoryAllocateFlagBits::eDeviceAddress};
    allocation.memory = vk::raii::DeviceMemory(
        device.device, vk::MemoryAllocateInfo{.pNext = &flags, .allocationSize = needs.size, .memoryTypeIndex = type});
    return allocation;
}

Buffer::Impl::Impl(Device::Impl& device, std::uint64_t size, Memory memory, const std::string& buffer_name)
    : name(buffer_name), size_bytes(size) {
    if (size == 0) throw Error(Code::kInternal, "buffer '" + name + "' has no bytes; at least 1 is needed");
    if (size > device.buffer_size_max) tooLarge(name, size, "the device's largest buffer has", device.buffer_size_max);
    buffer = vk::raii::Buffer(device.device, vk::BufferCreateInfo{.size = size, .usage = usages(device)});
    device.nameObject(buffer, name);
    const vk::MemoryRequirements needs = buffer.getMemoryRequirements();
    allocation = allocate(device, needs, memory, name);
    buffer.bindMemory(*allocation.memory, 0);
    if (memory != Memory::kDevice) mapped = static_cast<std::byte*>(allocation.memory.mapMemory(0, VK_WHOLE_SIZE));
    address = device.device.getBufferAddress(vk::BufferDeviceAddressInfo{.buffer = *buffer});
}

Buffer::Buffer(Device& device, std::uint64_t size_bytes, Memory memory, const std::string& name) {
    try {
        impl_ = std::make_unique<Impl>(device.impl(), size_bytes, memory, name);
    } catch (const vk::SystemError& error) {
        throw toError(error, "making buffer '" + name + "' of " + std::to_string(size_bytes) + " bytes");
    }
}

Buffer::Buffer() = default;
Buffer::~Buffer() = default;
Buffer::Buffer(Buffer&&) noexcept = default;
Buffer& Buffer::operator=(Buffer&&) noexcept = default;

std::uint64_t Buffer::sizeBytes() const { return impl_ ? impl_->size_bytes : 0; }
std::uint64_t Buffer::address() const { return impl_ ? impl_->address : 0; }

std::span<std::byte> Buffer::mapped() const {
    if (!impl_ || impl_->mapped == nullptr) return {};
    return {impl_->mapped, impl_->size_bytes};
}

void upload(Device& device, const Buffer& target, std::uint64_t offset_bytes, std::span<const std::byte> bytes) {
    if (bytes.empty()) return;
    const Buffer staging(device, std::min<std::uint64_t>(bytes.size(), kStagingBytes), Memory::kUpload, "upload staging");
    CommandRecorder recorder(device);
    for (std::uint64_t done = 0; done < bytes.size(); done += staging.sizeBytes()) {
        const std::uint64_t size = std::min<std::uint64_t>(bytes.size() - done, staging.sizeBytes());
        std::memcpy(staging.mapped().data(), bytes.data() + done, size);
        recorder.copy(staging, 0, target, offset_bytes + done, size);
        recorder.submitAndWait();
    }
}

void download(Device& device, const Buffer& source, std::uint64_t offset_bytes, std::span<std::byte> bytes) {
    if (bytes.empty()) return;
    const Buffer staging(device, std::min<std::uint64_t>(bytes.size(), kStagingBytes), Memory::kReadback, "download staging");
    CommandRecorder recorder(device);
    for (std::uint64_t done = 0; done < bytes.size(); done += staging.sizeBytes()) {
        const std::uint64_t size = std::min<std::uint64_t>(bytes.size() - done, staging.sizeBytes());
        recorder.copy(source, offset_bytes + done, staging, 0, size);
        recorder.submitAndWait();
        std::memcpy(bytes.data() + done, staging.mapped().data(), size);
    }
}

}  // namespace radiata::gpu
