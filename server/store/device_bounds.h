// Certified bounds of glyphs, sampled on the device: the same directions and the same certificate as BoundsEvaluator
// (build/bounds.h). On a CPU driver that one is faster (radiata-lab run peters-bounds); on GPUs this one.
#pragma once

#include <cstdint>
#include <span>

#include "build/bounds.h"
#include "gpu/buffer.h"
#include "gpu/pipeline.h"

namespace radiata::store {

/// Not thread-safe. The device must outlive it.
class DeviceBounds {
public:
    /// Uploads the directions and the basis on them: 4 (layout.count() + 3) bytes for each of about 1,600 directions at band 4
    /// and 18,000 at band 16.
    DeviceBounds(gpu::Device& device, ShLayout layout);

    /// \param coefficients  on the device, float[slots][stride], of which the first layout.count() of a slot count
    /// \param host          the same on the CPU
    /// \param slots         the glyphs wanted
    /// \return  one for each slot, as BoundsEvaluator::evaluate() gives them up to rounding, and as certain
    /// \throws Error(kInvalidArgument) for a coefficient that is not finite
    std::vector<GlyphBounds> evaluate(const gpu::Buffer& coefficients, std::span<const float> host, std::size_t stride,
                                      std::span<const std::uint32_t> slots, bool negative_lobes);

    /// Device time of the last evaluate().
    double timeMs() const { return time_ms_; }

private:
    gpu::Device& device_;
    BoundsEvaluator evaluator_;
    gpu::Buffer table_;
    gpu::ComputePipeline pipeline_;
    double time_ms_ = 0;
};

}  // namespace radiata::store
