// The region inside of a closed surface of triangles, of any shape: concave, in several parts, with hollows.
#pragma once

#include <memory>

#include "build/region_volume.h"
#include "model/triangle_mesh.h"

namespace radiata {

/// Inside is where a ray to infinity crosses the surface an odd number of times.
/// \throws Error(kInvalidArgument) for a mesh without triangles or with an edge that an odd number of triangles have: it is
/// open
std::unique_ptr<RegionVolume> meshVolume(const model::TriangleMesh& mesh);

}  // namespace radiata
