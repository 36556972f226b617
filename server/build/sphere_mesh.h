// Closed triangle meshes of the unit sphere, as tessellating glyph renderers deform them: MRtrix, FSLeyes and dmri-explorer use
// icospheres, Hlawitschka et al. 2011 (Table 2) latitude-longitude grids of resolution 7, 10 and 20.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "model/tessellation.h"

namespace radiata {

struct SphereTriangles {
    std::vector<glm::vec3> directions;     ///< unit
    std::vector<std::uint32_t> triangles;  ///< three indices each, counter-clockwise seen from outside
};

/// Polyhedra: midpoints of edges are moved to the sphere, `level` times. Grids: `level` bands of equal latitude, twice as many
/// meridians, one vertex per pole.
/// \throws Error as model::validate()
SphereTriangles sphereMesh(model::SphereMesh mesh, int level);

}  // namespace radiata
