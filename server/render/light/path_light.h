// What path tracing of pixels reads of a volume and its light, on the device: the lattice's parameters without its texels.
// Shader: shaders/isosurface/pixel_paths.comp.
#pragma once

#include <list>
#include <memory>

#include "gpu/buffer.h"
#include "model/illumination.h"
#include "render/light/lattice_light.h"
#include "store/volume_dataset.h"

namespace radiata::render {

class PathLight {
public:
    /// \param map  of the light's environment, or null  \param albedo  of the surface  \throws Error as LatticeLightBuffers
    PathLight(gpu::Device& device, std::shared_ptr<const store::VolumeDataset> volume, const model::Illumination& light,
              std::shared_ptr<const model::EnvironmentMap> map, const glm::vec3& albedo);

    /// Whether it is that of such a surface.
    bool serves(const store::VolumeDataset* volume, const model::Illumination& light, const model::EnvironmentMap* map,
                const glm::vec3& albedo) const;
    /// Of shader::LatticeParams.
    std::uint64_t address() const { return params_.address(); }

private:
    std::shared_ptr<const store::VolumeDataset> volume_;
    model::Illumination light_;
    std::shared_ptr<const model::EnvironmentMap> map_;
    glm::vec3 albedo_;
    LatticeLightBuffers buffers_;
    gpu::Buffer params_;
};

/// The latest ones, made when first asked for.
class PathLights {
public:
    std::shared_ptr<const PathLight> get(gpu::Device& device, const std::shared_ptr<const store::VolumeDataset>& volume,
                                         const model::Illumination& light,
                                         const std::shared_ptr<const model::EnvironmentMap>& map, const glm::vec3& albedo);

private:
    std::list<std::shared_ptr<const PathLight>> kept_;
};

}  // namespace radiata::render
