#include "gpu/device.h"

#include <algorithm>
#include <numeric>

#include "gpu/device_features.h"
#include "gpu/device_impl.h"
#include "gpu/instance.h"
#include "gpu/pipeline.h"
#include "gpu/pipeline_cache.h"

namespace radiata::gpu {
namespace {

// Ten minutes: longer than any bounded dispatch, even on a busy software device.
constexpr std::uint64_t kWaitMaxNs = 600'000'000'000;

/// What the device says about itself, for people and for the limits that buffers are held to.
void readProperties(Device::Impl& impl) {
    using Chain = vk::StructureChain<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceVulkan11Properties,
                                     vk::PhysicalDeviceDriverProperties, vk::PhysicalDeviceVulkan13Properties>;
    const Chain chain =
        impl.physical.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceVulkan11Properties,
                                     vk::PhysicalDeviceDriverProperties, vk::PhysicalDeviceVulkan13Properties>();
    impl.properties = chain.get<vk::PhysicalDeviceProperties2>().properties;
    impl.allocation_size_max = chain.get<vk::PhysicalDeviceVulkan11Properties>().maxMemoryAllocationSize;
    impl.buffer_size_max = chain.get<vk::PhysicalDeviceVulkan13Properties>().maxBufferSize;
    impl.memory = impl.physical.getMemoryProperties();
    const std::uint32_t bits = impl.physical.getQueueFamilyProperties()[impl.queue_family].timestampValidBits;
    impl.timestamp_mask = bits >= 64 ? ~0ULL : (1ULL << bits) - 1;

    const auto& driver = chain.get<vk::PhysicalDeviceDriverProperties>();
    impl.info.name = std::string(impl.properties.deviceName);
    impl.info.driver = std::string(driver.driverName) + " " + std::string(driver.driverInfo);
    impl.info.subgroup_size = chain.get<vk::PhysicalDeviceVulkan11Properties>().subgroupSize;
    impl.subgroup_size_max = chain.get<vk::PhysicalDeviceVulkan13Properties>().maxSubgroupSize;
    impl.info.storage_range_max = impl.properties.limits.maxStorageBufferRange;
    const vk::PhysicalDeviceLimits& core_limits = impl.properties.limits;
    impl.info.line_frame_px =
        std::min({16'384U, core_limits.maxViewportDimensions[0], core_limits.maxViewportDimensions[1]}) & ~1U;
    if (impl.has(Feature::kWideLines)) impl.info.line_width_max = impl.properties.limits.lineWidthRange[1];
    impl.info.software = impl.properties.deviceType == vk::PhysicalDeviceType::eCpu;
    for (std::uint32_t i = 0; i < impl.memory.memoryHeapCount; ++i) {
        const vk::MemoryHeap& heap = impl.memory.memoryHeaps[i];
        if (heap.flags & vk::MemoryHeapFlagBits::eDeviceLocal) {
            impl.info.memory_bytes = std::max<std::uint64_t>(impl.info.memory_bytes, heap.size);
        }
    }
    if (impl.has(Feature::kRayQuery)) {
        const auto limits =
            impl.physical.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceAccelerationStructurePropertiesKHR>()
                .get<vk::PhysicalDeviceAccelerationStructurePropertiesKHR>();
        impl.scratch_alignment = std::max(1U, limits.minAccelerationStructureScratchOffsetAlignment);
        impl.box_count_max = limits.maxPrimitiveCount;
    }
}

void makeLogicalDevice(Device::Impl& impl) {
    const Abilities abilities(impl.physical);
    impl.queue_family = abilities.queue_family.value();
    FeatureChain enabled;
    std::vector<const char*> extensions;
    for (const FeatureRow* row : chosenFeatures(abilities, impl.options.without)) {
        row->enable(enabled);
        extensions.insert(extensions.end(), row->extensions.begin(), row->extensions.end());
        if (row->feature) impl.features[static_cast<std::size_t>(*row->feature)] = true;
    }
    enabled.link({extensions.begin(), extensions.end()});
    const float priority = 1;
    const vk::DeviceQueueCreateInfo queue{
        .queueFamilyIndex = impl.queue_family, .queueCount = 1, .pQueuePriorities = &priority};
    impl.device = vk::raii::Device(impl.physical,
                                   vk::DeviceCreateInfo{.pNext = &enabled.core,
                                                        .queueCreateInfoCount = 1,
                                                        .pQueueCreateInfos = &queue,
                                                        .enabledExtensionCount = static_cast<std::uint32_t>(extensions.size()),
                                                        .ppEnabledExtensionNames = extensions.data()});
    impl.queue = vk::raii::Queue(impl.device, impl.queue_family, 0);
}

void makePipelineObjects(Device::Impl& impl) {
    std::vector<std::byte> bytes;
    if (!impl.options.pipeline_cache.empty()) bytes = readPipelineCache(impl.options.pipeline_cache, impl.properties);
    try {
        impl.pipeline_cache = vk::raii::PipelineCache(
            impl.device, vk::PipelineCacheCreateInfo{.initialDataSize = bytes.size(), .pInitialData = bytes.data()});
    } catch (const vk::SystemError&) {
        // A driver may refuse what it once wrote; an empty cache is only slower.
        impl.pipeline_cache = vk::raii::PipelineCache(impl.device, vk::PipelineCacheCreateInfo{});
    }
    using Stage = vk::ShaderStageFlagBits;
    impl.push_stages = Stage::eCompute | Stage::eVertex | Stage::eFragment;
    if (impl.has(Feature::kGeometryShader)) impl.push_stages |= Stage::eGeometry;
    if (impl.has(Feature::kTessellationShader)) {
        impl.push_stages |= Stage::eTessellationControl | Stage::eTessellationEvaluation;
    }
    if (impl.has(Feature::kMeshShader)) impl.push_stages |= Stage::eTaskEXT | Stage::eMeshEXT;
    const vk::PushConstantRange range{.stageFlags = impl.push_stages, .size = kPushConstantBytes};
    impl.pipeline_layout = vk::raii::PipelineLayout(
        impl.device, vk::PipelineLayoutCreateInfo{.pushConstantRangeCount = 1, .pPushConstantRanges = &range});
}

std::unique_ptr<Device::Impl> makeImpl() {
    try {
        return std::make_unique<Device::Impl>();
    } catch (const std::exception& error) {
        throw Error(Code::kUnavailable, std::string("the Vulkan loader is not there (Debian: libvulkan1): ") + error.what());
    }
}

}  // namespace

void Device::Impl::submitAndWait(const vk::raii::CommandBuffer& commands, const vk::raii::Fence& fence) {
    const vk::CommandBufferSubmitInfo submitted{.commandBuffer = *commands};
    device.resetFences(*fence);
    {
        std::lock_guard lock(queue_mutex);
        queue.submit2(vk::SubmitInfo2{.commandBufferInfoCount = 1, .pCommandBufferInfos = &submitted}, *fence);
    }
    if (device.waitForFences(*fence, VK_TRUE, kWaitMaxNs) == vk::Result::eTimeout) {
        throw Error(Code::kUnavailable, "'" + info.name + "' has not answered for ten minutes");
    }
}

Device::Device(const DeviceOptions& options) : impl_(makeImpl()) {
    impl_->options = options;
    try {
        impl_->instance = makeInstance(impl_->context, options.validation);
        if (options.validation) impl_->messenger = makeMessenger(impl_->instance, impl_->log);
        impl_->physical = chooseDevice(impl_->instance, options.device);
        makeLogicalDevice(*impl_);
        readProperties(*impl_);
        makePipelineObjects(*impl_);
    } catch (const vk::SystemError& error) {
        throw toError(error, "setting up the Vulkan device '" + options.device + "'");
    }
}

Device::~Device() {
    try {
        savePipelineCache();
    } catch (const std::exception&) {
        // The cache only saves time; a full disk must not keep a server from stopping.
    }
}

const DeviceInfo& Device::info() const { return impl_->info; }

bool Device::has(Feature feature) const { return impl_->has(feature); }

std::uint64_t Device::allocatedBytes() const {
    return std::accumulate(impl_->heap_bytes.begin(), impl_->heap_bytes.end(), std::uint64_t{0},
                           [](std::uint64_t sum, const auto& bytes) { return sum + bytes.load(); });
}

std::vector<std::string> Device::takeValidationMessages() {
    std::lock_guard lock(impl_->log.mutex);
    return std::exchange(impl_->log.messages, {});
}

void Device::savePipelineCache() {
    if (impl_->options.pipeline_cache.empty()) return;
    try {
        const std::vector<std::uint8_t> bytes = impl_->pipeline_cache.getData();
        writePipelineCache(impl_->options.pipeline_cache, std::as_bytes(std::span(bytes)));
    } catch (const vk::SystemError& error) {
        throw toError(error, "reading the pipeline cache from the driver");
    }
}

std::vector<std::string> Device::list() {
    const auto impl = makeImpl();
    impl->instance = makeInstance(impl->context, false);
    std::vector<std::string> names;
    for (const auto& device : listDevices(impl->instance)) names.emplace_back(device.getProperties().deviceName);
    return names;
}

}  // namespace radiata::gpu
