// Regions inside of meshes against exact answers of the shapes they are made of, and files of meshes.
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>

#include <gtest/gtest.h>

#include "base/error.h"
#include "build/distance_grid.h"
#include "build/region_mesh.h"
#include "io/mesh_file.h"
#include "model/selection_text.h"
#include "reference/winding_number.h"

namespace radiata {
namespace {

/// Boxes as twelve triangles each.
void addBox(model::TriangleMesh& mesh, const glm::vec3& low, const glm::vec3& high) {
    const auto first = static_cast<std::uint32_t>(mesh.points.size());
    for (int c = 0; c < 8; ++c) {
        mesh.points.emplace_back(c & 1 ? high.x : low.x, c & 2 ? high.y : low.y, c & 4 ? high.z : low.z);
    }
    const std::uint32_t faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    for (const auto& f : faces) {
        mesh.triangles.emplace_back(first + f[0], first + f[1], first + f[2]);
        mesh.triangles.emplace_back(first + f[0], first + f[2], first + f[3]);
    }
}

bool inBox(const glm::dvec3& p, double low, double high) {
    return glm::all(glm::greaterThan(p, glm::dvec3(low))) && glm::all(glm::lessThan(p, glm::dvec3(high)));
}

/// A box with a hollow: inside is between the two. Points on a grid pass through corners and edges of triangles on their rays.
TEST(MeshRegion, KnowsHollows) {
    model::TriangleMesh mesh;
    addBox(mesh, glm::vec3(-4), glm::vec3(4));
    addBox(mesh, glm::vec3(-2), glm::vec3(2));
    const auto region = meshVolume(mesh);
    int inside = 0;
    for (int i = 0; i < 25 * 25 * 25; ++i) {
        // Planes of the surface are left out: what lies on it may be either.
        const glm::dvec3 p = 0.5 * glm::dvec3(i % 25, i / 25 % 25, i / 625) - 6.25;
        const bool expected = inBox(p, -4, 4) && !inBox(p, -2, 2);
        ASSERT_EQ(region->contains(p), expected) << p.x << " " << p.y << " " << p.z;
        inside += expected;
    }
    EXPECT_GT(inside, 1000);
    for (int i = 0; i < 13 * 13; ++i) {
        // Right through corners, edges and diagonals of the faces: y and z are those of corners.
        const glm::dvec3 p(-0.5, i % 13 - 6, i / 13 - 6);
        const double far = std::max(std::abs(p.y), std::abs(p.z));
        if (far == 4 || far == 2) continue;
        ASSERT_EQ(region->contains(p), far < 4 && far > 2) << p.y << " " << p.z;
    }
    EXPECT_EQ(region->relate({2.5, 2.5, 2.5}, {3.5, 3.5, 3.5}), BoxRelation::kInside);
    EXPECT_EQ(region->relate(glm::dvec3(-1), glm::dvec3(1)), BoxRelation::kOutside);
    EXPECT_EQ(region->relate(glm::dvec3(-1), glm::dvec3(3)), BoxRelation::kUnknown);
    EXPECT_TRUE(region->meets({-10, 0, 0}, {10, 0, 0})) << "both ends are outside";
    EXPECT_FALSE(region->meets({-1, 0, 0}, {1, 0, 0}));
    EXPECT_TRUE(region->holds({3, -3, 0}, {3, 3, 0}));
    EXPECT_FALSE(region->holds({3, 0, 0}, {-3, 0, 0})) << "through the hollow";
}

/// A ball of triangles, against the ball: 20,000 random points farther from its surface than the mesh is.
TEST(MeshRegion, AgreesWithABall) {
    model::TriangleMesh mesh;
    const int rings = 24, steps = 48;
    for (int r = 0; r <= rings; ++r) {
        for (int s = 0; s < steps; ++s) {
            const double polar = M_PI * r / rings, turn = 2 * M_PI * s / steps;
            const bool pole = r == 0 || r == rings;
            if (pole && s > 0) continue;
            mesh.points.emplace_back(10 * std::sin(polar) * std::cos(turn), 10 * std::sin(polar) * std::sin(turn),
                                     10 * std::cos(polar));
        }
    }
    const auto at = [&](int r, int s) {
        return static_cast<std::uint32_t>(r == 0 ? 0 : r == rings ? 1 + (rings - 1) * steps : 1 + (r - 1) * steps + s % steps);
    };
    for (int r = 0; r < rings; ++r) {
        for (int s = 0; s < steps; ++s) {
            if (r > 0) mesh.triangles.emplace_back(at(r, s), at(r, s + 1), at(r + 1, s));
            if (r + 1 < rings) mesh.triangles.emplace_back(at(r, s + 1), at(r + 1, s + 1), at(r + 1, s));
        }
    }
    const auto region = meshVolume(mesh);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(-12, 12);
    for (int i = 0; i < 20'000; ++i) {
        const glm::dvec3 p(unit(random), unit(random), unit(random));
        const double radius = glm::length(p);
        if (radius > 9.85 && radius < 10.001) continue;
        ASSERT_EQ(region->contains(p), radius < 10) << i;
    }
    // Distances on a grid, within two steps of the ball's.
    const DistanceGrid grid = distanceGrid(*region, glm::dvec3(-5, 10, -20), glm::dvec3(40, 30, 20), 48);
    for (int z = 0; z < grid.size.z; ++z) {
        for (int y = 0; y < grid.size.y; ++y) {
            for (int x = 0; x < grid.size.x; ++x) {
                const double exact = std::max(glm::length(grid.origin_mm + grid.step_mm * glm::dvec3(x, y, z)) - 10, 0.0);
                const auto node = static_cast<std::size_t>((z * grid.size.y + y) * grid.size.x + x);
                // The box is grown so far that what lies in the box asked for is right.
                const glm::dvec3 p = grid.origin_mm + grid.step_mm * glm::dvec3(x, y, z);
                const bool asked = p.x >= -5 && p.x <= 40 && p.y >= 10 && p.y <= 30 && p.z >= -20 && p.z <= 20;
                if (!asked) continue;
                ASSERT_NEAR(static_cast<double>(grid.mm[node]), exact, 2 * grid.step_mm);
            }
        }
    }
}

/// A ring, turned: concave and with a hole. 5,000 points against how often the surface winds around them.
TEST(MeshRegion, AgreesWithTheWindingNumber) {
    model::TriangleMesh mesh;
    const int around = 30, tube = 14;
    const glm::dvec3 u = glm::normalize(glm::dvec3(1, 2, 3)), v = glm::normalize(glm::cross(u, glm::dvec3(0, 0, 1))),
                     w = glm::cross(u, v);
    for (int i = 0; i < around * tube; ++i) {
        const double a = 2 * M_PI * (i / tube) / around, b = 2 * M_PI * (i % tube) / tube, r = 8 + 3 * std::cos(b);
        mesh.points.emplace_back(r * std::cos(a) * u + r * std::sin(a) * v + 3 * std::sin(b) * w);
    }
    const auto at = [&](int i, int j) { return static_cast<std::uint32_t>(i % around * tube + j % tube); };
    for (int i = 0; i < around; ++i) {
        for (int j = 0; j < tube; ++j) {
            mesh.triangles.emplace_back(at(i, j), at(i + 1, j), at(i + 1, j + 1));
            mesh.triangles.emplace_back(at(i, j), at(i + 1, j + 1), at(i, j + 1));
        }
    }
    const auto region = meshVolume(mesh);
    std::mt19937 random(8);
    std::uniform_real_distribution<double> unit(-11, 11);
    int inside = 0;
    for (int i = 0; i < 5000; ++i) {
        const glm::dvec3 p(unit(random), unit(random), unit(random));
        const double winds = std::abs(reference::windingNumber(mesh, p));
        ASSERT_NEAR(winds, std::round(winds), 1e-6);
        ASSERT_EQ(region->contains(p), std::lround(winds) == 1) << i;
        inside += region->contains(p);
        // Boxes that are certain hold only such points.
        const double half = 0.2 + 0.05 * (i % 20);
        const BoxRelation relation = region->relate(p - half, p + half);
        if (relation == BoxRelation::kUnknown) continue;
        for (int c = 0; c < 8; ++c) {
            const glm::dvec3 q = p + half * glm::dvec3(c & 1 ? 1 : -1, c & 2 ? 1 : -1, c & 4 ? 1 : -1);
            ASSERT_EQ(std::lround(std::abs(reference::windingNumber(mesh, q))) == 1, relation == BoxRelation::kInside);
        }
    }
    EXPECT_GT(inside, 300);
}

TEST(MeshRegion, RefusesOpenSurfaces) {
    model::TriangleMesh mesh;
    addBox(mesh, glm::vec3(-4), glm::vec3(4));
    mesh.triangles.pop_back();
    EXPECT_THROW(meshVolume(mesh), Error);
    EXPECT_THROW(meshVolume({}), Error);
    EXPECT_EQ(model::parseRegion(" mesh(\"left thalamus\") ").dataset, "left thalamus");
    EXPECT_EQ(model::regionText(model::parseRegion("mesh(a)")), "mesh(\"a\")");
    EXPECT_THROW(model::parseRegion("mesh(a) and mesh(b)"), Error);
    EXPECT_THROW(model::parseRegion("length(1, 2)"), Error);
}

class MeshFiles : public ::testing::Test {
protected:
    std::filesystem::path write(const std::string& name, const std::string& bytes) {
        const std::filesystem::path path = std::filesystem::temp_directory_path() / ("radiata_mesh_" + name);
        std::ofstream(path, std::ios::binary) << bytes;
        return path;
    }
};

TEST_F(MeshFiles, AreReadInAllThreeForms) {
    const std::string obj =
        "# box\nv 0 0 0\nv 1 0 0\nv 0 1 0\r\nv 0 0 1\nvn 0 0 1\nf 1/1/1 3//2 2\nf 1 2 4\nf -4 -1 -2\nf 2 3 4\n";
    const model::TriangleMesh first = io::readMesh(write("a.obj", obj));
    EXPECT_EQ(first.points.size(), 4);
    ASSERT_EQ(first.triangles.size(), 4);
    EXPECT_TRUE(meshVolume(first)->contains({0.1, 0.2, 0.3}));
    EXPECT_FALSE(meshVolume(first)->contains({0.5, 0.5, 0.5}));
    std::string text = "solid box\n", binary(80, ' ');
    const auto number = static_cast<std::uint32_t>(first.triangles.size());
    binary.append(reinterpret_cast<const char*>(&number), 4);
    for (const glm::uvec3& t : first.triangles) {
        text += "facet normal 0 0 0\nouter loop\n";
        binary.append(12, '\0');
        for (int i = 0; i < 3; ++i) {
            const glm::vec3& p = first.points[t[i]];
            text += "vertex " + std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z) + "\n";
            binary.append(reinterpret_cast<const char*>(&p), 12);
        }
        text += "endloop\nendfacet\n";
        binary.append(2, '\0');
    }
    for (const auto& path : {write("a.stl", text + "endsolid\n"), write("b.STL", binary)}) {
        const model::TriangleMesh mesh = io::readMesh(path);
        EXPECT_EQ(mesh.points.size(), 4) << path;
        EXPECT_EQ(mesh.triangles.size(), 4) << path;
        EXPECT_TRUE(meshVolume(mesh)->contains({0.1, 0.2, 0.3})) << path;
    }
}

/// Every cut of a file and every changed byte gives a mesh or an Error, never a crash.
TEST_F(MeshFiles, SurviveDamage) {
    const std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    for (const char* bad :
         {"v 0 0\n", "v 0 0 x\n", "v 0 0 nan\n", "v 0 0 1e9\n", "f 1 2 3\n", "f 1 2 9\n", "f 1 2\n", "", "f 0 1 2\n"}) {
        const bool empty = std::string(bad).empty(), late = std::string(bad).starts_with("f 1 2 9");
        EXPECT_THROW(io::readMesh(write("bad.obj", empty ? "" : late ? obj + bad : bad)), Error) << bad;
    }
    std::string binary(84 + 50, '\1');
    const std::uint32_t one = 1;
    std::memcpy(&binary[80], &one, 4);
    for (std::size_t cut = 0; cut < binary.size(); cut += 7)
        EXPECT_THROW(io::readMesh(write("cut.stl", binary.substr(0, cut))), Error) << cut;
    std::mt19937 random(3);
    for (int i = 0; i < 300; ++i) {
        std::string damaged = obj;
        damaged[random() % damaged.size()] = static_cast<char>(random());
        try {
            io::readMesh(write("flip.obj", damaged));
        } catch (const Error&) {
        }
    }
}

}  // namespace
}  // namespace radiata
