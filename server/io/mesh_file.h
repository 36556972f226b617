// Surfaces of triangles: Wavefront .obj (v and f lines; polygons become fans) and .stl, binary or text. Corners of .stl files
// at equal places are one point. Coordinates are world mm, RAS.
#pragma once

#include <filesystem>

#include "model/triangle_mesh.h"

namespace radiata::io {

/// Whether a name ends in .obj or .stl, in any case.
bool isMeshName(const std::filesystem::path& path);

/// \throws Error(kNotFound, kUnavailable) if it cannot be read, (kCorrupt) naming the line or triangle, (kResourceExhausted)
/// above 2^28
///         bytes
model::TriangleMesh readMesh(const std::filesystem::path& path);

}  // namespace radiata::io
