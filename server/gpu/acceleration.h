// Ray-query acceleration structure over axis-aligned boxes.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "gpu/fwd.h"

namespace radiata::gpu {

/// Layout of VkAabbPositionsKHR.
struct Aabb {
    float min[3];
    float max[3];
};

/// A top-level structure with one instance of one bottom-level structure; primitive index = index of the box.
/// Built once; needs Feature::kRayQuery. In GLSL: accelerationStructureEXT(address).
class BoxAcceleration {
public:
    BoxAcceleration();
    /// \throws Error(kUnsupported) without ray queries, Error(kResourceExhausted) for memory
    BoxAcceleration(Device& device, std::span<const Aabb> boxes);
    ~BoxAcceleration();
    BoxAcceleration(BoxAcceleration&&) noexcept;
    BoxAcceleration& operator=(BoxAcceleration&&) noexcept;
    explicit operator bool() const { return impl_ != nullptr; }
    std::uint64_t address() const;
    std::uint64_t sizeBytes() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace radiata::gpu
