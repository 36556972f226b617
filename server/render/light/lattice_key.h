// What lattices are like, from what is asked for: how many texels, how large they are, and what a saved one must agree in. Any
// thread may ask, before there is a lattice.
#pragma once

#include <cstdint>
#include <string>

#include <glm/glm.hpp>

#include "io/lattice_file.h"
#include "model/illumination.h"
#include "store/volume_dataset.h"

namespace radiata::render {

double voxelsPerTexel(model::LatticeResolution resolution);
/// Texels along the axes. \param samples  of the volume
glm::ivec3 latticeSize(const glm::ivec3& samples, model::LatticeResolution resolution);
std::uint64_t latticeProduct(const glm::ivec3& v);
/// Of one texel's payload.
std::uint64_t texelBytes(const model::Illumination& light);

/// In words: volume, settings and, of irradiance, the light. \param map  of the environment, or null
std::string latticeKey(const store::VolumeDataset& volume, const model::Illumination& light, const model::EnvironmentMap* map,
                       const glm::vec3& albedo);
/// Of the file that such a lattice is saved to.
io::LatticeHeader latticeHeader(const store::VolumeDataset& volume, const model::Illumination& light,
                                const model::EnvironmentMap* map, const glm::vec3& albedo);

}  // namespace radiata::render
