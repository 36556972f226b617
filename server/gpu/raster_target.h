// What triangles are drawn into: a depth of 32-bit float and four words of 32 bits per pixel, whose meaning the shaders agree
// on.
#pragma once

#include <cstdint>
#include <memory>

#include "gpu/fwd.h"

namespace radiata::gpu {

/// Move-only owner of the two images. Where nothing was drawn since CommandRecorder::clear(), words and depth are 0; of several
/// triangles the one with the greatest depth stays, of equal ones the first drawn (depth falls away from the viewer).
class RasterTarget {
public:
    RasterTarget();
    /// \throws Error(kUnsupported) without Feature::kRaster, Error(kResourceExhausted) if the device draws no picture as large
    /// or
    ///         has no memory for it
    RasterTarget(Device& device, std::uint32_t width, std::uint32_t height);
    ~RasterTarget();
    RasterTarget(RasterTarget&&) noexcept;
    RasterTarget& operator=(RasterTarget&&) noexcept;
    explicit operator bool() const { return impl_ != nullptr; }
    std::uint32_t width() const;
    std::uint32_t height() const;

    struct Impl;
    Impl& impl() const { return *impl_; }

    static constexpr std::uint64_t kWordBytesPerPixel = 16, kDepthBytesPerPixel = 4;

private:
    std::unique_ptr<Impl> impl_;
};

}  // namespace radiata::gpu
