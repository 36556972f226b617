// The validation layers are really there: misuse is caught, by the core checks and by those of synchronisation.
#include <algorithm>

#include "gpu/buffer_impl.h"
#include "gpu/device/fixture.h"
#include "gpu/recorder.h"

namespace radiata::gpu {
namespace {

bool anyContains(const std::vector<std::string>& messages, const std::string& text) {
    return std::ranges::any_of(messages, [&](const std::string& message) { return message.find(text) != std::string::npos; });
}

TEST(Validation, CatchesACopyOntoItself) {
    Device device(DeviceOptions{.validation = true});
    const Buffer buffer(device, 64, Memory::kDevice, "snake");
    CommandRecorder recorder(device);
    recorder.copy(buffer, 0, buffer, 8, 16);
    const std::vector<std::string> messages = device.takeValidationMessages();
    EXPECT_TRUE(anyContains(messages, "VUID-vkCmdCopyBuffer-pRegions-00117"));
    EXPECT_TRUE(anyContains(messages, "snake")) << "objects carry their names";
    EXPECT_TRUE(device.takeValidationMessages().empty()) << "messages are taken once";
}

TEST(Validation, CatchesAMissingBarrier) {
    Device device(DeviceOptions{.validation = true});
    const Buffer buffer(device, 64, Memory::kDevice, "raced");
    const vk::raii::Device& raw = device.impl().device;
    const vk::raii::CommandPool pool(raw, vk::CommandPoolCreateInfo{.queueFamilyIndex = device.impl().queue_family});
    const vk::raii::CommandBuffers commands(raw, vk::CommandBufferAllocateInfo{.commandPool = *pool, .commandBufferCount = 1});
    commands[0].begin(vk::CommandBufferBeginInfo{});
    commands[0].fillBuffer(*buffer.impl().buffer, 0, 64, 1);
    commands[0].fillBuffer(*buffer.impl().buffer, 0, 64, 2);
    commands[0].end();
    EXPECT_TRUE(anyContains(device.takeValidationMessages(), "SYNC-HAZARD-WRITE-AFTER-WRITE"));
}

TEST(Validation, IsSilentWhereItIsOff) {
    Device device(DeviceOptions{});
    const Buffer buffer(device, 64, Memory::kDevice, "unwatched");
    CommandRecorder recorder(device);
    recorder.copy(buffer, 0, buffer, 8, 16);
    recorder.discard();
    EXPECT_TRUE(device.takeValidationMessages().empty());
}

}  // namespace
}  // namespace radiata::gpu
