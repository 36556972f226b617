// A scalar volume on the device, for isosurfaces: samples, and the ranges by which rays leave out what is empty.
#pragma once

#include <cstdint>

#include "gpu/buffer.h"
#include "model/scalar_image.h"
#include "shaders/shared/isosurface.glsl"

namespace radiata::store {

/// Immutable. The device must outlive it.
class VolumeDataset {
public:
    /// \throws Error(kInvalidArgument) for fewer than two samples along an axis or no number at all, (kResourceExhausted) if it
    ///         does not fit the device
    VolumeDataset(gpu::Device& device, const model::ScalarImage& image);

    const shader::VolumeParams& params() const { return params_; }
    float valueMin() const { return value_min_; }
    float valueMax() const { return value_max_; }
    /// What splits the values best in two: the isovalue of those who ask for none.
    float valueSplit() const { return value_split_; }
    /// Sample (i, j, k) lies at (i, j, k).
    glm::dvec3 worldToGrid(const glm::dvec3& p_mm) const { return glm::dvec3(world_to_grid_ * glm::dvec4(p_mm, 1)); }
    glm::dvec3 gridToWorld(const glm::dvec3& p_grid) const { return glm::dvec3(grid_to_world_ * glm::dvec4(p_grid, 1)); }
    /// Voxels that are NaN, infinite or beyond 3e38: cells with one of them in a corner have no surface.
    std::uint64_t noValue() const { return no_value_; }
    /// CRC-32 of the samples, which tells this volume from others.
    std::uint32_t check() const { return check_; }
    std::uint64_t gpuBytes() const { return samples_.sizeBytes() + ranges_.sizeBytes(); }

private:
    gpu::Buffer samples_, ranges_;
    shader::VolumeParams params_{};
    glm::dmat4 grid_to_world_{1.0}, world_to_grid_{1.0};
    float value_min_ = 0, value_max_ = 0, value_split_ = 0;
    std::uint64_t no_value_ = 0;
    std::uint32_t check_ = 0;
};

}  // namespace radiata::store
