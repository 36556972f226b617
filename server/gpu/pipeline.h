// Compute pipelines. Their whole interface is one block of push constants, which holds buffer addresses and numbers;
// there are no descriptor sets.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "gpu/fwd.h"

namespace radiata::gpu {

/// One SPIR-V module as the build embeds it (see shaders/CMakeLists.txt).
struct Shader {
    std::string_view name;  ///< e.g. "glyph_trace_even8"
    std::span<const std::uint32_t> spirv;
};

/// Bytes of push constants that every pipeline may use.
constexpr std::uint32_t kPushConstantBytes = 128;

class ComputePipeline {
public:
    ComputePipeline();
    /// \param constants  specialisation constants; constants[i] has constant_id i
    /// \throws Error(kUnsupported or kInternal) naming the shader
    ComputePipeline(Device& device, const Shader& shader, std::span<const std::uint32_t> constants);
    ~ComputePipeline();
    ComputePipeline(ComputePipeline&&) noexcept;
    ComputePipeline& operator=(ComputePipeline&&) noexcept;
    explicit operator bool() const { return impl_ != nullptr; }
    const std::string& shaderName() const;

    struct Impl;
    const Impl& impl() const { return *impl_; }

private:
    std::unique_ptr<Impl> impl_;
};

}  // namespace radiata::gpu
