#include "render/light/transport_params.h"

namespace radiata::render {

shader::LatticeParams transportParams(const store::VolumeDataset& volume, const model::Illumination& light) {
    shader::LatticeParams params{};
    const shader::VolumeParams& grid = volume.params();
    params.volume = grid;
    const glm::dmat3 to_grid(glm::dvec3(grid.grid_x), glm::dvec3(grid.grid_y), glm::dvec3(grid.grid_z));
    const glm::dmat3 to_mm = glm::inverse(to_grid);
    params.mm_x = glm::vec3(to_mm[0]);
    params.mm_y = glm::vec3(to_mm[1]);
    params.mm_z = glm::vec3(to_mm[2]);
    params.value_step = 1e-5F * (volume.valueMax() - volume.valueMin());
    params.bounces = static_cast<std::uint32_t>(light.bounces);
    return params;
}

}  // namespace radiata::render
