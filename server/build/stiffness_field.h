// A sample of a field of elasticity tensors, 3x3x3x3 in every voxel: a brick of fibre-reinforced material under a load on its
// top. Stands in for the simulated brick of Hlawitschka et al., Fig. 5, whose data are not public.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "model/sh_image.h"

namespace radiata {

struct StiffnessOptions {
    std::uint64_t seed = 1;
    int size = 24;  ///< voxels along the longest edge (x) of the brick, 2 to 256
};

/// In every voxel the 21 numbers on and above the diagonal of the 6x6 stiffness matrix in GPa, Voigt's order without factors
/// (math/elasticity.h): carbon fibres in epoxy (orthotropic: 140, 10, 9 GPa along the fibre and across), whose course waves
/// through the layers, softened where the load crushes the matrix; where voids replace the material it is weaker in every
/// direction.
struct StiffnessField {
    glm::ivec3 size{0};
    glm::dmat4 voxel_to_world{1.0};
    std::vector<std::array<double, 21>> matrices;  ///< x fastest, then y, z
};

/// The same for the same options on every machine's double arithmetic.
/// \throws Error(kInvalidArgument) for a size out of range
StiffnessField stiffnessField(const StiffnessOptions& options);

/// The field as readers deliver it: tensors of order 4 and their bands.
model::ShImage stiffnessImage(const StiffnessOptions& options);

}  // namespace radiata
