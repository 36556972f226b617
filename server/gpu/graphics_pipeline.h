// Pipelines that draw triangles into a RasterTarget. As with compute, their whole interface is one block of push constants:
// vertices are fetched from buffers by address, and there are no descriptor sets.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "gpu/pipeline.h"

namespace radiata::gpu {

enum class Faces { kAll, kBack };  ///< back: those whose corners run clockwise as seen

/// The greater depth wins, the earlier of equal ones. What is written as depth is from 0 (excluded) to 1.
class GraphicsPipeline {
public:
    GraphicsPipeline();
    /// \param constants  specialisation constants of both stages; constants[i] has constant_id i
    /// \throws Error(kUnsupported or kInternal) naming the fragment shader
    GraphicsPipeline(Device& device, const Shader& vertex, const Shader& fragment, std::span<const std::uint32_t> constants,
                     Faces faces);
    ~GraphicsPipeline();
    GraphicsPipeline(GraphicsPipeline&&) noexcept;
    GraphicsPipeline& operator=(GraphicsPipeline&&) noexcept;
    explicit operator bool() const { return impl_ != nullptr; }
    /// Of the fragment shader.
    const std::string& shaderName() const;

    struct Impl;
    const Impl& impl() const { return *impl_; }

private:
    std::unique_ptr<Impl> impl_;
};

}  // namespace radiata::gpu
