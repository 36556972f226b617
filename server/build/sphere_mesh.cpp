#include "build/sphere_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace radiata {
namespace {

struct Mesh {
    std::vector<glm::dvec3> directions;
    std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// All triangles of corners that are mutually at the least distance, turned outwards: the faces of a regular polyhedron.
Mesh polyhedron(const std::vector<glm::dvec3>& corners) {
    Mesh mesh;
    for (const glm::dvec3& corner : corners) mesh.directions.push_back(glm::normalize(corner));
    double nearest = -1;
    for (std::size_t i = 1; i < corners.size(); ++i) {
        nearest = std::max(nearest, glm::dot(mesh.directions[0], mesh.directions[i]));
    }
    const auto count = static_cast<std::uint32_t>(corners.size());
    auto adjacent = [&](std::uint32_t i, std::uint32_t j) {
        return glm::dot(mesh.directions[i], mesh.directions[j]) > nearest - 1e-9;
    };
    for (std::uint32_t i = 0; i < count; ++i) {
        for (std::uint32_t j = i + 1; j < count; ++j) {
            for (std::uint32_t k = j + 1; k < count; ++k) {
                if (!adjacent(i, j) || !adjacent(j, k) || !adjacent(k, i)) continue;
                const glm::dvec3 &a = mesh.directions[i], &b = mesh.directions[j], &c = mesh.directions[k];
                const bool outwards = glm::dot(glm::cross(b - a, c - a), a) > 0;
                mesh.triangles.push_back(outwards ? std::array{i, j, k} : std::array{i, k, j});
            }
        }
    }
    return mesh;
}

Mesh startingPolyhedron(model::SphereMesh kind) {
    if (kind == model::SphereMesh::kTetrahedron) return polyhedron({{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}});
    std::vector<glm::dvec3> corners;
    const double golden = (1 + std::sqrt(5.0)) / 2;
    for (const double a : {-1.0, 1.0}) {
        if (kind == model::SphereMesh::kOctahedron) {
            corners.insert(corners.end(), {{a, 0, 0}, {0, a, 0}, {0, 0, a}});
            continue;
        }
        for (const double b : {-golden, golden}) corners.insert(corners.end(), {{0, a, b}, {a, b, 0}, {b, 0, a}});
    }
    return polyhedron(corners);
}

Mesh subdivided(const Mesh& coarse) {
    Mesh fine;
    fine.directions = coarse.directions;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    auto middle = [&](std::uint32_t i, std::uint32_t j) {
        const auto [found, is_new] = middles.try_emplace(std::minmax(i, j), static_cast<std::uint32_t>(fine.directions.size()));
        if (is_new) fine.directions.push_back(glm::normalize(coarse.directions[i] + coarse.directions[j]));
        return found->second;
    };
    fine.triangles.reserve(4 * coarse.triangles.size());
    for (const auto& [a, b, c] : coarse.triangles) {
        const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
        fine.triangles.insert(fine.triangles.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    return fine;
}

Mesh latitudeLongitude(std::uint32_t bands) {
    Mesh mesh;
    const std::uint32_t meridians = 2 * bands;
    mesh.directions.emplace_back(0, 0, 1);
    for (std::uint32_t i = 1; i < bands; ++i) {
        const double polar = std::numbers::pi * i / bands;
        for (std::uint32_t j = 0; j < meridians; ++j) {
            const double azimuth = 2 * std::numbers::pi * j / meridians;
            mesh.directions.emplace_back(std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth),
                                         std::cos(polar));
        }
    }
    mesh.directions.emplace_back(0, 0, -1);
    const auto south = static_cast<std::uint32_t>(mesh.directions.size() - 1);
    auto at = [&](std::uint32_t ring, std::uint32_t j) { return 1 + (ring - 1) * meridians + j % meridians; };
    for (std::uint32_t j = 0; j < meridians; ++j) {
        mesh.triangles.push_back({0, at(1, j), at(1, j + 1)});
        for (std::uint32_t ring = 1; ring + 1 < bands; ++ring) {
            mesh.triangles.push_back({at(ring, j), at(ring + 1, j), at(ring + 1, j + 1)});
            mesh.triangles.push_back({at(ring, j), at(ring + 1, j + 1), at(ring, j + 1)});
        }
        mesh.triangles.push_back({south, at(bands - 1, j + 1), at(bands - 1, j)});
    }
    return mesh;
}

}  // namespace

SphereTriangles sphereMesh(model::SphereMesh mesh, int level) {
    model::validate(model::Tessellation{.mesh = mesh, .level = level});
    Mesh made;
    if (mesh == model::SphereMesh::kLatitudeLongitude) {
        made = latitudeLongitude(static_cast<std::uint32_t>(level));
    } else {
        made = startingPolyhedron(mesh);
        for (int i = 0; i < level; ++i) made = subdivided(made);
    }
    SphereTriangles result;
    result.directions.assign(made.directions.begin(), made.directions.end());
    for (const auto& triangle : made.triangles)
        result.triangles.insert(result.triangles.end(), triangle.begin(), triangle.end());
    return result;
}

}  // namespace radiata
