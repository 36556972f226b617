// The Vulkan objects behind Device, shared by gpu/*.cpp only.
#pragma once

#include <array>
#include <atomic>
#include <mutex>
#include <string>
#include <vector>

#include "gpu/device.h"
#include "gpu/vulkan_error.h"

#include <vulkan/vulkan_raii.hpp>

namespace radiata::gpu {

/// What the validation layers said; their callback may come from any thread.
struct MessageLog {
    std::mutex mutex;
    std::vector<std::string> messages;
};

/// Members stand in the order in which they are made; they die in the reverse order.
struct Device::Impl {
    DeviceOptions options;
    MessageLog log;
    vk::raii::Context context;
    vk::raii::Instance instance{nullptr};
    vk::raii::DebugUtilsMessengerEXT messenger{nullptr};
    vk::raii::PhysicalDevice physical{nullptr};
    vk::raii::Device device{nullptr};
    vk::raii::Queue queue{nullptr};
    std::mutex queue_mutex;  ///< a queue is externally synchronised: held while submitting, not while waiting
    vk::raii::PipelineCache pipeline_cache{nullptr};
    vk::raii::PipelineLayout pipeline_layout{nullptr};  ///< push constants only, the same for every pipeline

    DeviceInfo info;
    std::uint32_t queue_family = 0;
    vk::PhysicalDeviceProperties properties;
    vk::PhysicalDeviceMemoryProperties memory;
    std::uint64_t allocation_size_max = 0;       ///< bytes of one allocation
    std::uint64_t buffer_size_max = 0;           ///< bytes of one buffer
    std::uint64_t scratch_alignment = 1;         ///< of scratch addresses of acceleration-structure builds
    std::uint64_t box_count_max = 0;             ///< boxes in one acceleration structure
    std::uint32_t subgroup_size_max = 1;         ///< invocations
    std::uint64_t timestamp_mask = 0;            ///< valid bits
    std::array<bool, kFeatureCount> features{};  ///< by Feature

    std::array<std::atomic<std::uint64_t>, VK_MAX_MEMORY_HEAPS> heap_bytes{};  ///< taken by live buffers
    std::atomic<std::uint32_t> allocation_count{0};

    /// Stages that push constants reach: one layout serves compute and drawing by all stages that the device has.
    vk::ShaderStageFlags push_stages;

    bool has(Feature feature) const { return features[static_cast<std::size_t>(feature)]; }

    /// Submits ended commands and waits until they are done; `fence` must not be in use.
    /// \throws vk::SystemError if the device is lost, Error(kUnavailable) if it does not answer for ten minutes
    void submitAndWait(const vk::raii::CommandBuffer& commands, const vk::raii::Fence& fence);

    /// Name for validation messages; nothing without validation.
    template <typename Handle>
    void nameObject(const Handle& handle, const std::string& name) const {
        if (!options.validation) return;
        const auto raw = static_cast<typename std::remove_cvref_t<decltype(*handle)>::CType>(*handle);
        device.setDebugUtilsObjectNameEXT(vk::DebugUtilsObjectNameInfoEXT{.objectType = Handle::objectType,
                                                                          .objectHandle = reinterpret_cast<std::uint64_t>(raw),
                                                                          .pObjectName = name.c_str()});
    }
};

}  // namespace radiata::gpu
