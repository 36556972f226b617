// What a CommandRecorder holds, shared by gpu/*.cpp only.
#pragma once

#include <string>
#include <vector>

#include "gpu/buffer_impl.h"
#include "gpu/recorder.h"

namespace radiata::gpu {

constexpr std::uint32_t kTimedPasses = 512;  // between two submits; one more submits what is there

/// Everything recorded before is visible to what comes after.
void barrierBeforeWork(const vk::raii::CommandBuffer& commands);
/// \throws Error(kInternal) naming the buffer
void checkRange(const Buffer& buffer, std::uint64_t offset, std::uint64_t size, const char* what);

struct CommandRecorder::Impl {
    explicit Impl(Device::Impl& owner);
    void begin();
    void submitAndWait();
    void collectTimes();
    void addTime(const std::string& pass, const std::string& shader, double time_ms);
    /// Opens a timed pass: barrier, push constants, timestamp. \return what endPass() wants
    std::uint32_t startPass(const void* push, std::size_t push_size);
    void endPass(std::uint32_t query, const std::string& pass, const std::string& shader);

    struct Timed {
        std::string pass;
        std::string shader;
    };

    Device::Impl& device;
    vk::raii::CommandPool pool{nullptr};
    vk::raii::CommandBuffer commands{nullptr};
    vk::raii::QueryPool queries{nullptr};
    vk::raii::Fence fence{nullptr};
    bool recording = false;
    std::vector<Timed> timed;  ///< passes since the last submit; number i has queries 2 i and 2 i + 1
    std::vector<PassTiming> timings;
};

}  // namespace radiata::gpu
