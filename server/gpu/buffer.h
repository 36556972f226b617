// Device memory with an address. Shaders reach buffers by address (buffer_reference), so no descriptor range limits their size.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "gpu/fwd.h"

namespace radiata::gpu {

enum class Memory {
    kDevice,    ///< not seen by the CPU (unless the device has one kind of memory only)
    kUpload,    ///< written by the CPU, read by the device
    kReadback,  ///< written by the device, read by the CPU
};

/// Move-only owner of one buffer. The device must outlive it; work that uses it must be done before it dies.
class Buffer {
public:
    Buffer();
    /// \param size_bytes  at least 1; \param name  for validation messages and memory reports
    /// \throws Error(kResourceExhausted) saying name, size and what the device has
    Buffer(Device& device, std::uint64_t size_bytes, Memory memory, const std::string& name);
    ~Buffer();
    Buffer(Buffer&&) noexcept;
    Buffer& operator=(Buffer&&) noexcept;

    explicit operator bool() const { return impl_ != nullptr; }
    std::uint64_t sizeBytes() const;
    std::uint64_t address() const;
    /// The CPU's view; empty for kDevice.
    std::span<std::byte> mapped() const;
    template <typename T>
    std::span<T> as() const {
        auto bytes = mapped();
        return {reinterpret_cast<T*>(bytes.data()), bytes.size() / sizeof(T)};
    }

    struct Impl;
    const Impl& impl() const { return *impl_; }

private:
    std::unique_ptr<Impl> impl_;
};

/// Copies bytes into a device buffer through a staging buffer, in pieces of bounded size; returns when they are there.
/// \throws Error(kInternal) if they do not fit
void upload(Device& device, const Buffer& target, std::uint64_t offset_bytes, std::span<const std::byte> bytes);
/// Reads bytes of a device buffer back; returns when they are there. For tests, tools and start-up; frames use a recorder.
void download(Device& device, const Buffer& source, std::uint64_t offset_bytes, std::span<std::byte> bytes);

}  // namespace radiata::gpu
