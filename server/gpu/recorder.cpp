#include "gpu/recorder.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "gpu/pipeline_impl.h"
#include "gpu/recorder_impl.h"

namespace radiata::gpu {
namespace {

using Stage = vk::PipelineStageFlagBits2;
using Access = vk::AccessFlagBits2;

void memoryBarrier(const vk::raii::CommandBuffer& commands, const vk::MemoryBarrier2& barrier) {
    commands.pipelineBarrier2(vk::DependencyInfo{.memoryBarrierCount = 1, .pMemoryBarriers = &barrier});
}

void barrierBeforeHost(const vk::raii::CommandBuffer& commands) {
    memoryBarrier(commands, {.srcStageMask = Stage::eAllCommands,
                             .srcAccessMask = Access::eMemoryWrite,
                             .dstStageMask = Stage::eHost,
                             .dstAccessMask = Access::eHostRead});
}

}  // namespace

// Passes are few and long, so one full barrier between any two costs nothing that can be measured and forgets nothing.
void barrierBeforeWork(const vk::raii::CommandBuffer& commands) {
    memoryBarrier(commands, {.srcStageMask = Stage::eAllCommands,
                             .srcAccessMask = Access::eMemoryWrite,
                             .dstStageMask = Stage::eAllCommands,
                             .dstAccessMask = Access::eMemoryRead | Access::eMemoryWrite});
}

void checkRange(const Buffer& buffer, std::uint64_t offset, std::uint64_t size, const char* what) {
    if (!buffer) throw Error(Code::kInternal, std::string(what) + ": the buffer was never made");
    if (offset > buffer.sizeBytes() || size > buffer.sizeBytes() - offset) {
        throw Error(Code::kInternal, std::string(what) + " of " + std::to_string(size) + " bytes at " + std::to_string(offset) +
                                         " does not fit buffer '" + buffer.impl().name + "' of " +
                                         std::to_string(buffer.sizeBytes()) + " bytes");
    }
}

CommandRecorder::Impl::Impl(Device::Impl& owner)
    : device(owner),
      pool(owner.device, vk::CommandPoolCreateInfo{.flags = vk::CommandPoolCreateFlagBits::eTransient,
                                                   .queueFamilyIndex = owner.queue_family}),
      queries(owner.device, vk::QueryPoolCreateInfo{.queryType = vk::QueryType::eTimestamp, .queryCount = 2 * kTimedPasses}),
      fence(owner.device, vk::FenceCreateInfo{}) {
    vk::raii::CommandBuffers buffers(
        owner.device, vk::CommandBufferAllocateInfo{
                          .commandPool = *pool, .level = vk::CommandBufferLevel::ePrimary, .commandBufferCount = 1});
    commands = std::move(buffers.front());
    owner.nameObject(commands, "recorder");
}

void CommandRecorder::Impl::begin() {
    if (recording) return;
    pool.reset();
    commands.begin(vk::CommandBufferBeginInfo{.flags = vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
    commands.resetQueryPool(*queries, 0, 2 * kTimedPasses);
    recording = true;
}

void CommandRecorder::Impl::submitAndWait() {
    if (!recording) return;
    barrierBeforeHost(commands);
    commands.end();
    recording = false;
    device.submitAndWait(commands, fence);
    collectTimes();
}

void CommandRecorder::Impl::collectTimes() {
    if (timed.empty()) return;
    const std::vector<Timed> done = std::exchange(timed, {});
    const auto count = static_cast<std::uint32_t>(2 * done.size());
    const auto [result, ticks] =
        queries.getResults<std::uint64_t>(0, count, count * sizeof(std::uint64_t), sizeof(std::uint64_t),
                                          vk::QueryResultFlagBits::e64 | vk::QueryResultFlagBits::eWait);
    for (std::size_t i = 0; i < done.size(); ++i) {
        const std::uint64_t elapsed = (ticks[2 * i + 1] - ticks[2 * i]) & device.timestamp_mask;
        addTime(done[i].pass, done[i].shader,
                static_cast<double>(elapsed) * static_cast<double>(device.properties.limits.timestampPeriod) * 1e-6);
    }
}

void CommandRecorder::Impl::addTime(const std::string& pass, const std::string& shader, double time_ms) {
    const auto known = std::ranges::find(timings, pass, &PassTiming::name);
    if (known != timings.end()) {
        known->time_ms += time_ms;
    } else {
        timings.push_back({pass, shader, time_ms});
    }
}

std::uint32_t CommandRecorder::Impl::startPass(const void* push, std::size_t push_size) {
    if (timed.size() == kTimedPasses) submitAndWait();
    begin();
    std::array<std::byte, kPushConstantBytes> bytes{};
    std::memcpy(bytes.data(), push, push_size);
    const std::size_t whole_words = (push_size + 3) / 4 * 4;
    barrierBeforeWork(commands);
    commands.pushConstants<std::byte>(*device.pipeline_layout, device.push_stages, 0,
                                      {static_cast<std::uint32_t>(whole_words), bytes.data()});
    const auto query = static_cast<std::uint32_t>(2 * timed.size());
    commands.writeTimestamp2(Stage::eAllCommands, *queries, query);
    return query;
}

void CommandRecorder::Impl::endPass(std::uint32_t query, const std::string& pass, const std::string& shader) {
    commands.writeTimestamp2(Stage::eAllCommands, *queries, query + 1);
    timed.push_back({pass, shader});
}

CommandRecorder::CommandRecorder(Device& device) {
    try {
        impl_ = std::make_unique<Impl>(device.impl());
    } catch (const vk::SystemError& error) {
        throw toError(error, "making a command recorder");
    }
}

CommandRecorder::~CommandRecorder() = default;

void CommandRecorder::dispatchBytes(const ComputePipeline& pipeline, const std::string& pass, std::uint32_t groups_x,
                                    std::uint32_t groups_y, std::uint32_t groups_z, const void* push, std::size_t push_size) {
    const auto& most = impl_->device.properties.limits.maxComputeWorkGroupCount;
    if (groups_x > most[0] || groups_y > most[1] || groups_z > most[2]) {
        throw Error(Code::kInternal, "pass '" + pass + "' asks for " + std::to_string(groups_x) + " x " +
                                         std::to_string(groups_y) + " x " + std::to_string(groups_z) +
                                         " workgroups; the device allows " + std::to_string(most[0]) + " x " +
                                         std::to_string(most[1]) + " x " + std::to_string(most[2]));
    }
    if (groups_x == 0 || groups_y == 0 || groups_z == 0) return;
    try {
        const std::uint32_t query = impl_->startPass(push, push_size);
        impl_->commands.bindPipeline(vk::PipelineBindPoint::eCompute, *pipeline.impl().pipeline);
        impl_->commands.dispatch(groups_x, groups_y, groups_z);
        impl_->endPass(query, pass, pipeline.shaderName());
    } catch (const vk::SystemError& error) {
        throw toError(error, "recording pass '" + pass + "'");
    }
}

void CommandRecorder::copy(const Buffer& source, std::uint64_t source_offset, const Buffer& target, std::uint64_t target_offset,
                           std::uint64_t size_bytes) {
    checkRange(source, source_offset, size_bytes, "copying from");
    checkRange(target, target_offset, size_bytes, "copying to");
    if (size_bytes == 0) return;
    try {
        impl_->begin();
        barrierBeforeWork(impl_->commands);
        impl_->commands.copyBuffer(*source.impl().buffer, *target.impl().buffer,
                                   vk::BufferCopy{.srcOffset = source_offset, .dstOffset = target_offset, .size = size_bytes});
    } catch (const vk::SystemError& error) {
        throw toError(error, "recording a copy to buffer '" + target.impl().name + "'");
    }
}

void CommandRecorder::fill(const Buffer& target, std::uint64_t offset_bytes, std::uint64_t size_bytes, std::uint32_t word) {
    checkRange(target, offset_bytes, size_bytes, "filling");
    if (offset_bytes % 4 != 0 || size_bytes % 4 != 0) {
        throw Error(Code::kInternal, "filling buffer '" + target.impl().name + "': offset " + std::to_string(offset_bytes) +
                                         " and size " + std::to_string(size_bytes) + " must be multiples of 4");
    }
    if (size_bytes == 0) return;
    try {
        impl_->begin();
        barrierBeforeWork(impl_->commands);
        impl_->commands.fillBuffer(*target.impl().buffer, offset_bytes, size_bytes, word);
    } catch (const vk::SystemError& error) {
        throw toError(error, "recording a fill of buffer '" + target.impl().name + "'");
    }
}

void CommandRecorder::discard() {
    impl_->recording = false;
    impl_->timed.clear();
}

void CommandRecorder::submitAndWait() {
    try {
        impl_->submitAndWait();
    } catch (const vk::SystemError& error) {
        discard();
        throw toError(error, "running commands on '" + impl_->device.info.name + "'");
    }
}

std::vector<PassTiming> CommandRecorder::takeTimings() { return std::exchange(impl_->timings, {}); }

}  // namespace radiata::gpu
