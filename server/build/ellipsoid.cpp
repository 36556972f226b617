#include "build/ellipsoid.h"

#include <algorithm>
#include <cmath>

namespace radiata {
namespace {

/// Eigenvectors as columns by Jacobi's rotations (Golub and Van Loan, Sec. 8.5); the matrix becomes diagonal.
glm::dmat3 diagonalise(glm::dmat3& matrix) {
    glm::dmat3 vectors(1.0);
    for (int sweep = 0; sweep < 30; ++sweep) {
        for (int p = 0; p < 2; ++p) {
            for (int q = p + 1; q < 3; ++q) {
                const double off = matrix[q][p];
                if (off == 0) continue;
                const double tau = (matrix[q][q] - matrix[p][p]) / (2 * off);
                const double t = (tau >= 0 ? 1.0 : -1.0) / (std::abs(tau) + std::hypot(1.0, tau));
                const double c = 1 / std::hypot(1.0, t), s = t * c;
                glm::dmat3 turn(1.0);
                turn[p][p] = turn[q][q] = c;
                turn[q][p] = s;
                turn[p][q] = -s;
                matrix = glm::transpose(turn) * matrix * turn;
                matrix[q][p] = matrix[p][q] = 0;
                vectors = vectors * turn;
            }
        }
    }
    return vectors;
}

}  // namespace

Ellipsoid ellipsoidOf(std::span<const float> components) {
    const glm::dmat3 tensor(components[0], components[1], components[2], components[1], components[3], components[4],
                            components[2], components[4], components[5]);
    double scale = 0;
    for (int column = 0; column < 3; ++column) {
        for (int row = 0; row < 3; ++row) scale = std::max(scale, std::abs(tensor[column][row]));
    }
    Ellipsoid ellipsoid;
    if (!(scale > 0)) return ellipsoid;
    glm::dmat3 diagonal = tensor / scale;
    const glm::dmat3 vectors = diagonalise(diagonal);
    glm::dvec3 axes(std::abs(diagonal[0][0]), std::abs(diagonal[1][1]), std::abs(diagonal[2][2]));
    const double longest = std::max({axes.x, axes.y, axes.z});
    axes = glm::max(axes, glm::dvec3(kEllipsoidFlattest * longest));
    const auto made = [&](const glm::dvec3& values) {
        glm::dmat3 scaled = vectors;
        for (int i = 0; i < 3; ++i) scaled[i] = scaled[i] * values[i];
        return scaled * glm::transpose(vectors);
    };
    const glm::dmat3 matrix = made(axes), inverse = made(1.0 / axes);
    const double grown = scale * (1 + 1e-6);
    for (int axis = 0; axis < 3; ++axis) ellipsoid.extent[axis] = static_cast<float>(grown * glm::length(matrix[axis]));
    ellipsoid.radius = static_cast<float>(grown * longest);
    ellipsoid.longest = static_cast<float>(scale * longest);
    ellipsoid.inverse = {static_cast<float>(inverse[0][0] / scale), static_cast<float>(inverse[0][1] / scale),
                         static_cast<float>(inverse[0][2] / scale), static_cast<float>(inverse[1][1] / scale),
                         static_cast<float>(inverse[1][2] / scale), static_cast<float>(inverse[2][2] / scale)};
    return ellipsoid;
}

}  // namespace radiata
