// Each edge of the icosahedron is cut into `frequency` equal arcs. The triangles between the points cover the sphere, and each
// point x of a spherical triangle lies within its circumradius R (centre c) of a corner v_i: else (x - c).v_i < 0 for all
// three, so (x - c).x < 0 as x is a combination of the v_i with weights >= 0, that is c.x > 1.
#include "build/sphere_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <set>

namespace radiata {
namespace {

using Face = std::array<glm::dvec3, 3>;

std::vector<Face> icosahedronFaces() {
    const double golden = (1 + std::sqrt(5.0)) / 2;
    std::vector<glm::dvec3> corners;
    for (double a : {-1.0, 1.0}) {
        for (double b : {-golden, golden}) {
            for (const glm::dvec3& corner : {glm::dvec3(0, a, b), glm::dvec3(a, b, 0), glm::dvec3(b, 0, a)}) {
                corners.push_back(glm::normalize(corner));
            }
        }
    }
    const double adjacent = 1 / std::sqrt(5.0) - 1e-9;  // cosine between neighbouring corners
    std::vector<Face> faces;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        for (std::size_t j = i + 1; j < corners.size(); ++j) {
            for (std::size_t k = j + 1; k < corners.size(); ++k) {
                if (glm::dot(corners[i], corners[j]) > adjacent && glm::dot(corners[j], corners[k]) > adjacent &&
                    glm::dot(corners[k], corners[i]) > adjacent) {
                    faces.push_back({corners[i], corners[j], corners[k]});
                }
            }
        }
    }
    return faces;
}

/// Point (i, j, frequency - i - j) of a face. Sines as weights make equal arcs on the edges and nearly equal triangles inside.
glm::dvec3 facePoint(const Face& face, int i, int j, int frequency) {
    const double step = std::acos(1 / std::sqrt(5.0)) / frequency;
    return glm::normalize(std::sin(i * step) * face[0] + std::sin(j * step) * face[1] +
                          std::sin((frequency - i - j) * step) * face[2]);
}

double circumradius(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const glm::dvec3 normal = glm::normalize(glm::cross(b - a, c - a));
    return std::acos(std::min(1.0, std::abs(glm::dot(normal, a))));
}

/// All faces are alike, so one tells the covering radius of the grid.
double coveringRadius(const Face& face, int frequency) {
    double radius = 0;
    for (int i = 0; i < frequency; ++i) {
        for (int j = 0; i + j < frequency; ++j) {
            const glm::dvec3 a = facePoint(face, i + 1, j, frequency);
            const glm::dvec3 b = facePoint(face, i, j + 1, frequency);
            radius = std::max(radius, circumradius(a, b, facePoint(face, i, j, frequency)));
            if (i + j + 2 <= frequency) radius = std::max(radius, circumradius(a, b, facePoint(face, i + 1, j + 1, frequency)));
        }
    }
    return radius + 1e-7;  // for the rounding of acos near 1
}

/// The one of d and -d whose last coordinate that is not zero is positive.
glm::dvec3 canonical(const glm::dvec3& d) {
    for (int axis : {2, 1, 0}) {
        if (std::abs(d[axis]) > 1e-9) return d[axis] > 0 ? d : -d;
    }
    return d;
}

}  // namespace

SphereGrid sphereGrid(double radius_max, bool half) {
    const std::vector<Face> faces = icosahedronFaces();
    SphereGrid grid;
    int frequency = 1;
    while ((grid.covering_radius = coveringRadius(faces.front(), frequency)) > radius_max) ++frequency;
    std::set<std::array<std::int64_t, 3>> seen;
    for (const Face& face : faces) {
        for (int i = 0; i <= frequency; ++i) {
            for (int j = 0; i + j <= frequency; ++j) {
                glm::dvec3 d = facePoint(face, i, j, frequency);
                if (half) d = canonical(d);
                const glm::dvec3 key = glm::round(d * 1e7);
                if (seen.insert({std::int64_t(key.x), std::int64_t(key.y), std::int64_t(key.z)}).second) {
                    grid.directions.push_back(d);
                }
            }
        }
    }
    return grid;
}

}  // namespace radiata
