// The scene's light as the lattice's passes read it.
#pragma once

#include <memory>
#include <vector>

#include "gpu/buffer.h"
#include "model/illumination.h"
#include "shaders/shared/lattice.glsl"
#include "store/volume_dataset.h"

namespace radiata::render {

/// Owns the device arrays of one light.
class LatticeLightBuffers {
public:
    /// \param map  of the light's environment, or null  \param volume  whose grid lights in the scene are placed in
    /// \throws Error as lightHarmonics(); Error(kInvalidArgument) for an environment without its map
    /// \param former  of the same map, whose pixels are taken over; may be null
    LatticeLightBuffers(gpu::Device& device, const model::Illumination& light, const model::EnvironmentMap* map,
                        const store::VolumeDataset& volume, LatticeLightBuffers* former = nullptr);

    const shader::LatticeLight& params() const { return params_; }
    /// Luminance of the irradiance of a surface that everything shines on from its front: what relative errors are held against
    /// a hundredth of.
    float openIrradiance() const { return open_irradiance_; }
    /// Radiance of a white surface that 8-bit texels reach to: half as much again as where distant light falls from everywhere
    /// at once, for what bounces.
    float radianceMax() const { return radiance_max_; }

private:
    void addMap(gpu::Device& device, const model::EnvironmentMap& map, LatticeLightBuffers* former);

    const model::EnvironmentMap* map_source_ = nullptr;
    double bright_weight_ = 0;
    gpu::Buffer map_, bright_, suns_, spheres_, harmonics_;
    shader::LatticeLight params_{};
    float open_irradiance_ = 0, radiance_max_ = 0;
};

}  // namespace radiata::render
