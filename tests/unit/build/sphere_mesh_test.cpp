// Meshes of the sphere: counts, closedness, orientation, evenness.
#include "build/sphere_mesh.h"

#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include <gtest/gtest.h>

#include "base/error.h"

namespace radiata {
namespace {

using model::SphereMesh;

struct Case {
    SphereMesh mesh;
    int level;
    std::size_t vertices, triangles;
};

const Case kCases[] = {
    {SphereMesh::kIcosphere, 0, 12, 20},
    {SphereMesh::kIcosphere, 2, 162, 320},
    {SphereMesh::kIcosphere, 3, 642, 1280},
    {SphereMesh::kIcosphere, 4, 2562, 5120},
    {SphereMesh::kIcosphere, 5, 10242, 20480},
    {SphereMesh::kIcosphere, 6, 40962, 81920},
    {SphereMesh::kOctahedron, 0, 6, 8},
    {SphereMesh::kOctahedron, 4, 1026, 2048},
    {SphereMesh::kTetrahedron, 0, 4, 4},
    {SphereMesh::kTetrahedron, 5, 2050, 4096},
    {SphereMesh::kLatitudeLongitude, 2, 6, 8},
    {SphereMesh::kLatitudeLongitude, 7, 86, 168},
    {SphereMesh::kLatitudeLongitude, 10, 182, 360},
    {SphereMesh::kLatitudeLongitude, 20, 762, 1520},
};

TEST(SphereMesh, HasTheStatedCountsAndIsClosed) {
    for (const Case& x : kCases) {
        const SphereTriangles mesh = sphereMesh(x.mesh, x.level);
        EXPECT_EQ(mesh.directions.size(), x.vertices);
        EXPECT_EQ(mesh.triangles.size(), 3 * x.triangles);
        EXPECT_EQ(model::meshVertices(x.mesh, x.level), x.vertices);
        EXPECT_EQ(model::meshTriangles(x.mesh, x.level), x.triangles);
        // Each edge is used once in each sense: closed and coherently oriented. V - E + F = 2: one sphere.
        std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
        for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
            for (std::size_t c = 0; c < 3; ++c) {
                EXPECT_TRUE(edges.emplace(mesh.triangles[i + c], mesh.triangles[i + (c + 1) % 3]).second);
            }
        }
        for (const auto& [from, to] : edges) EXPECT_TRUE(edges.contains({to, from}));
        EXPECT_EQ(x.vertices + x.triangles, edges.size() / 2 + 2);
    }
}

TEST(SphereMesh, FacesOutwardsAndEnclosesTheVolumeOfItsLevel) {
    for (const Case& x : kCases) {
        const SphereTriangles mesh = sphereMesh(x.mesh, x.level);
        for (const glm::vec3& direction : mesh.directions) EXPECT_NEAR(glm::length(glm::dvec3(direction)), 1, 1e-7);
        double volume = 0, longest = 0;
        for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
            const glm::dvec3 a(mesh.directions[mesh.triangles[i]]), b(mesh.directions[mesh.triangles[i + 1]]),
                c(mesh.directions[mesh.triangles[i + 2]]);
            const double part = glm::dot(a, glm::cross(b, c)) / 6;
            EXPECT_GT(part, 0);
            volume += part;
            longest = std::max(longest, glm::length(b - a));
        }
        // Points of a triangle whose edges have length s are at least sqrt(1 - s^2) from the centre.
        const double sphere = 4 * std::numbers::pi / 3;
        EXPECT_LT(volume, sphere);
        if (longest >= 1) continue;
        EXPECT_GT(volume, sphere * std::pow(1 - longest * longest, 1.5));
    }
}

TEST(SphereMesh, RefusesWhatIsTooLargeNamingTheLimit) {
    auto message = [](SphereMesh mesh, int level) -> std::string {
        try {
            sphereMesh(mesh, level);
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_NE(message(SphereMesh::kIcosphere, 7).find("at most 65536 are drawn per glyph, level 6"), std::string::npos);
    EXPECT_NE(message(SphereMesh::kTetrahedron, 100).find("level 7"), std::string::npos);
    EXPECT_NE(message(SphereMesh::kLatitudeLongitude, 2'000'000'000).find("level 181"), std::string::npos);
    EXPECT_NE(message(SphereMesh::kLatitudeLongitude, 1).find("at least 2"), std::string::npos);
    EXPECT_NE(message(SphereMesh::kOctahedron, -1).find("at least 0"), std::string::npos);
    EXPECT_EQ(message(SphereMesh::kOctahedron, 6), "");
}

}  // namespace
}  // namespace radiata
