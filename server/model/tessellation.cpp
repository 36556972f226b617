#include "model/tessellation.h"

#include <algorithm>
#include <string>

#include "base/error.h"

namespace radiata::model {
namespace {

constexpr int kLevelMost = 20;  // beyond it everything counts as too many; 20 * 4^20 still fits 64 bits

std::uint64_t faces(SphereMesh mesh) { return mesh == SphereMesh::kIcosphere ? 20 : mesh == SphereMesh::kOctahedron ? 8 : 4; }

}  // namespace

std::uint64_t meshTriangles(SphereMesh mesh, int level) {
    if (mesh == SphereMesh::kLatitudeLongitude) {
        const auto bands = static_cast<std::uint64_t>(level);
        return 4 * bands * (bands - 1);
    }
    return faces(mesh) << (2 * std::min(level, kLevelMost));
}

// Closed surfaces of genus 0 with three edges per two triangles: Euler's formula leaves half the triangles plus two.
std::uint64_t meshVertices(SphereMesh mesh, int level) { return meshTriangles(mesh, level) / 2 + 2; }

void validate(const Tessellation& tessellation) {
    const bool grid = tessellation.mesh == SphereMesh::kLatitudeLongitude;
    const int least = grid ? 2 : 0;
    const std::string level = "quality.tessellation.level is " + std::to_string(tessellation.level);
    if (tessellation.level < least) {
        throw Error(Code::kInvalidArgument,
                    level + "; it must be at least " + std::to_string(least) + (grid ? " for a latitude-longitude grid" : ""));
    }
    const std::uint64_t vertices = meshVertices(tessellation.mesh, tessellation.level);
    if (vertices <= kMeshVerticesMax) return;
    int most = least;
    while (meshVertices(tessellation.mesh, most + 1) <= kMeshVerticesMax) ++most;
    throw Error(Code::kResourceExhausted, level + ", a mesh of too many vertices; at most " + std::to_string(kMeshVerticesMax) +
                                              " are drawn per glyph, level " + std::to_string(most) + " of this mesh");
}

}  // namespace radiata::model
