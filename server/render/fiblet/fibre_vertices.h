// A tractogram's points without compression on the device, for the pipelines that are there to compare with.
#pragma once

#include <cstdint>
#include <vector>

#include "gpu/buffer.h"
#include "model/fiblet_set.h"

namespace radiata::render {

/// As viewers keep them that know no fiblets: 16 bytes a point, fibre after fibre. Fibres of one point are left out.
class FibreVertices {
public:
    /// \throws Error(kUnsupported) for 2^32 points or more, Error(kResourceExhausted)
    FibreVertices(gpu::Device& device, const model::FibletSet& set);

    std::uint64_t address() const { return vertices_.address(); }  ///< shader::FibreVertex[]
    std::uint32_t count() const { return first_.back(); }
    std::uint32_t strips() const { return static_cast<std::uint32_t>(first_.size()) - 1; }
    /// Where strip i, or what follows the last, begins.
    const std::vector<std::uint32_t>& first() const { return first_; }
    std::uint64_t fibreFirstAddress() const { return fibre_first_.address(); }  ///< uint of each fibre: its first vertex
    /// One VkDrawIndirectCommand for each strip.
    const gpu::Buffer& commands() const { return commands_; }
    std::uint64_t deviceBytes() const { return vertices_.sizeBytes() + commands_.sizeBytes() + fibre_first_.sizeBytes(); }

private:
    std::vector<std::uint32_t> first_{0};
    gpu::Buffer vertices_, commands_, fibre_first_;
};

}  // namespace radiata::render
