#include "reference/winding_number.h"

#include <cmath>
#include <numbers>

namespace radiata::reference {

double windingNumber(const model::TriangleMesh& mesh, const glm::dvec3& p) {
    double angle = 0;
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::dvec3 a = glm::dvec3(mesh.points[t.x]) - p, b = glm::dvec3(mesh.points[t.y]) - p,
                         c = glm::dvec3(mesh.points[t.z]) - p;
        const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
        const double below = la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb;
        angle += 2 * std::atan2(glm::dot(a, glm::cross(b, c)), below);
    }
    return angle / (4 * std::numbers::pi);
}

}  // namespace radiata::reference
