#include "gpu/acceleration.h"

#include <cstring>

#include "gpu/buffer_impl.h"

namespace radiata::gpu {
namespace {

using BuildFlag = vk::BuildAccelerationStructureFlagBitsKHR;
using Type = vk::AccelerationStructureTypeKHR;

/// One structure with the memory it lives in.
struct Structure {
    Buffer memory;
    vk::raii::AccelerationStructureKHR handle{nullptr};
    std::uint64_t address = 0;
};

/// Submits what `record` puts into a command buffer and waits.
template <typename Record>
void runOnce(Device::Impl& device, const Record& record) {
    const vk::raii::CommandPool pool(
        device.device,
        vk::CommandPoolCreateInfo{.flags = vk::CommandPoolCreateFlagBits::eTransient, .queueFamilyIndex = device.queue_family});
    const vk::raii::CommandBuffers buffers(
        device.device, vk::CommandBufferAllocateInfo{
                           .commandPool = *pool, .level = vk::CommandBufferLevel::ePrimary, .commandBufferCount = 1});
    const vk::raii::CommandBuffer& commands = buffers.front();
    commands.begin(vk::CommandBufferBeginInfo{.flags = vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
    record(commands);
    // The next submit's shaders read the structure, and nothing else there waits for this stage.
    const vk::MemoryBarrier2 barrier{
        .srcStageMask = vk::PipelineStageFlagBits2::eAccelerationStructureBuildKHR,
        .srcAccessMask = vk::AccessFlagBits2::eAccelerationStructureWriteKHR,
        .dstStageMask = vk::PipelineStageFlagBits2::eComputeShader | vk::PipelineStageFlagBits2::eAccelerationStructureBuildKHR,
        .dstAccessMask = vk::AccessFlagBits2::eAccelerationStructureReadKHR};
    commands.pipelineBarrier2(vk::DependencyInfo{.memoryBarrierCount = 1, .pMemoryBarriers = &barrier});
    commands.end();
    const vk::raii::Fence fence(device.device, vk::FenceCreateInfo{});
    device.submitAndWait(commands, fence);
}

Structure buildStructure(Device& owner, Type type, const vk::AccelerationStructureGeometryKHR& geometry, std::uint32_t count,
                         const std::string& name) {
    Device::Impl& device = owner.impl();
    vk::AccelerationStructureBuildGeometryInfoKHR build{.type = type,
                                                        .flags = BuildFlag::ePreferFastTrace,
                                                        .mode = vk::BuildAccelerationStructureModeKHR::eBuild,
                                                        .geometryCount = 1,
                                                        .pGeometries = &geometry};
    const vk::AccelerationStructureBuildSizesInfoKHR sizes =
        device.device.getAccelerationStructureBuildSizesKHR(vk::AccelerationStructureBuildTypeKHR::eDevice, build, count);

    Structure made;
    made.memory = Buffer(owner, sizes.accelerationStructureSize, Memory::kDevice, name);
    made.handle = vk::raii::AccelerationStructureKHR(
        device.device, vk::AccelerationStructureCreateInfoKHR{
                           .buffer = *made.memory.impl().buffer, .size = sizes.accelerationStructureSize, .type = type});
    device.nameObject(made.handle, name);
    const std::uint64_t alignment = device.scratch_alignment;
    const Buffer scratch(owner, sizes.buildScratchSize + alignment, Memory::kDevice, name + " scratch");
    build.dstAccelerationStructure = *made.handle;
    build.scratchData.deviceAddress = (scratch.address() + alignment - 1) / alignment * alignment;
    const vk::AccelerationStructureBuildRangeInfoKHR range{.primitiveCount = count};
    runOnce(device, [&](const vk::raii::CommandBuffer& commands) { commands.buildAccelerationStructuresKHR(build, &range); });
    made.address = device.device.getAccelerationStructureAddressKHR({.accelerationStructure = *made.handle});
    return made;
}

Structure buildBoxes(Device& device, std::span<const Aabb> boxes) {
    static_assert(sizeof(Aabb) == sizeof(VkAabbPositionsKHR));
    const Buffer input(device, boxes.size_bytes(), Memory::kDevice, "boxes to accelerate");
    upload(device, input, 0, std::as_bytes(boxes));
    vk::AccelerationStructureGeometryKHR geometry{.geometryType = vk::GeometryTypeKHR::eAabbs,
                                                  .flags = vk::GeometryFlagBitsKHR::eOpaque};
    geometry.geometry.setAabbs(vk::AccelerationStructureGeometryAabbsDataKHR{
        .data = vk::DeviceOrHostAddressConstKHR(input.address()), .stride = sizeof(Aabb)});
    return buildStructure(device, Type::eBottomLevel, geometry, static_cast<std::uint32_t>(boxes.size()), "box structure");
}

Structure buildInstance(Device& device, const Structure& boxes) {
    VkAccelerationStructureInstanceKHR instance{};
    for (int i = 0; i < 3; ++i) instance.transform.matrix[i][i] = 1;
    instance.mask = 0xff;
    instance.accelerationStructureReference = boxes.address;
    const Buffer input(device, sizeof instance, Memory::kUpload, "instance to accelerate");
    std::memcpy(input.mapped().data(), &instance, sizeof instance);
    vk::AccelerationStructureGeometryKHR geometry{.geometryType = vk::GeometryTypeKHR::eInstances};
    geometry.geometry.setInstances(
        vk::AccelerationStructureGeometryInstancesDataKHR{.data = vk::DeviceOrHostAddressConstKHR(input.address())});
    return buildStructure(device, Type::eTopLevel, geometry, 1, "box scene structure");
}

}  // namespace

struct BoxAcceleration::Impl {
    Structure boxes;
    Structure top;
};

BoxAcceleration::BoxAcceleration(Device& device, std::span<const Aabb> boxes) {
    if (!device.has(Feature::kRayQuery)) {
        throw Error(Code::kUnsupported, "'" + device.info().name + "' has no ray queries, or they were left off (ray_query)");
    }
    if (boxes.empty()) throw Error(Code::kInvalidArgument, "an acceleration structure needs at least 1 box, got 0");
    if (boxes.size() > device.impl().box_count_max) {
        throw Error(Code::kResourceExhausted, std::to_string(boxes.size()) + " boxes are more than the " +
                                                  std::to_string(device.impl().box_count_max) +
                                                  " that the device's acceleration structures hold");
    }
    try {
        impl_ = std::make_unique<Impl>();
        impl_->boxes = buildBoxes(device, boxes);
        impl_->top = buildInstance(device, impl_->boxes);
    } catch (const vk::SystemError& error) {
        throw toError(error, "building an acceleration structure of " + std::to_string(boxes.size()) + " boxes");
    }
}

BoxAcceleration::BoxAcceleration() = default;
BoxAcceleration::~BoxAcceleration() = default;
BoxAcceleration::BoxAcceleration(BoxAcceleration&&) noexcept = default;
BoxAcceleration& BoxAcceleration::operator=(BoxAcceleration&&) noexcept = default;

std::uint64_t BoxAcceleration::address() const { return impl_ ? impl_->top.address : 0; }

std::uint64_t BoxAcceleration::sizeBytes() const {
    return impl_ ? impl_->boxes.memory.sizeBytes() + impl_->top.memory.sizeBytes() : 0;
}

}  // namespace radiata::gpu
