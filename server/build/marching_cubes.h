// Triangles of an isosurface: one loop or more per cell through the crossings on its edges. What programs commonly draw; here
// to compare with exact hits. Source: Lorensen and Cline 1987. The table of the 256 cases is not theirs but made by following
// the crossings around each face, where two diagonal corners inside are taken apart: neighbours agree, so surfaces are closed.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "model/scalar_image.h"

namespace radiata {

struct SurfaceMesh {
    std::vector<glm::vec3> positions;      ///< grid coordinates, one per crossed edge of the grid
    std::vector<glm::vec3> normals;        ///< per grid unit, unit length, away from the larger values; of central differences
    std::vector<std::uint32_t> triangles;  ///< three each, counterclockwise seen from the smaller values
};

/// Edges of the loops of one case, each an edge number 0 to 11; edge 4 a + n runs along axis a, its place on the other two axes
/// in the bits of n, the axis after a first. \param inside  bit c: corner c (x fastest) has at least the isovalue
std::vector<std::vector<int>> cubeLoops(unsigned inside);

/// Cells with a corner that is no number have no triangles.
/// \throws Error(kInvalidArgument) for less than two samples along an axis, Error(kResourceExhausted) for more than 2^31
/// corners
SurfaceMesh marchCubes(const model::ScalarImage& image, float isovalue);

}  // namespace radiata
