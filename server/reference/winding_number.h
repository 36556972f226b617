// How often a surface of triangles winds around a point: the sum of the solid angles of all triangles over 4 pi. The oracle of
// regions by meshes, which count crossings of a ray (server/build/region_mesh.h). Source: Van Oosterom and Strackee 1983,
// Eq. 8.
#pragma once

#include <glm/glm.hpp>

#include "model/triangle_mesh.h"

namespace radiata::reference {

/// Off by rounding only; whole numbers for closed surfaces whose triangles all turn alike, an odd one inside.
double windingNumber(const model::TriangleMesh& mesh, const glm::dvec3& p);

}  // namespace radiata::reference
