// Which triangles stand for a glyph where it is drawn as a deformed sphere.
#pragma once

#include <cstdint>

namespace radiata::model {

enum class SphereMesh { kIcosphere, kOctahedron, kTetrahedron, kLatitudeLongitude };
enum class MeshNormals { kAnalytic, kTriangle };

struct Tessellation {
    SphereMesh mesh = SphereMesh::kIcosphere;
    /// Polyhedra: how often each triangle is split in four. Latitude-longitude grids: bands from pole to pole, half as many as
    /// meridians.
    int level = 4;
    MeshNormals normals = MeshNormals::kAnalytic;
    bool operator==(const Tessellation&) const = default;
};

/// What build/sphere_mesh makes; saturates instead of overflowing. \param level  at least 0, grids at least 2
std::uint64_t meshVertices(SphereMesh mesh, int level);
std::uint64_t meshTriangles(SphereMesh mesh, int level);

/// Vertices of the largest mesh that is drawn: an icosphere of level 6 has 40,962.
constexpr std::uint64_t kMeshVerticesMax = 65'536;
/// Triangles of all glyphs of one layer in one picture.
constexpr std::uint64_t kLayerTrianglesMax = 2'000'000'000;

/// \throws Error(kInvalidArgument) for a negative level or a grid of fewer than 2 bands, Error(kResourceExhausted) for a mesh
/// of more than kMeshVerticesMax vertices
void validate(const Tessellation& tessellation);

}  // namespace radiata::model
