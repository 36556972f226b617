#include "build/stiffness_field.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "base/error.h"
#include "build/phantom_random.h"
#include "math/cartesian_tensor.h"
#include "math/elasticity.h"
#include "math/tensor_sh.h"

namespace radiata {
namespace {

using Matrix6 = std::array<std::array<double, 6>, 6>;

/// Stiffness of an orthotropic material from its engineering constants, fibre along x: the inverse of its compliance.
/// Shear moduli stand on the diagonal; the block of the normal strains is inverted by cofactors.
Matrix6 orthotropic(double ex, double ey, double ez, double nu_xy, double nu_xz, double nu_yz, double gyz, double gxz,
                    double gxy) {
    const glm::dmat3 compliance(1 / ex, -nu_xy / ex, -nu_xz / ex, -nu_xy / ex, 1 / ey, -nu_yz / ey, -nu_xz / ex, -nu_yz / ey,
                                1 / ez);
    const glm::dmat3 block = glm::inverse(compliance);
    Matrix6 stiffness{};
    for (std::size_t row = 0; row < 3; ++row) {
        for (std::size_t column = 0; column < 3; ++column) {
            stiffness[row][column] = block[static_cast<int>(column)][static_cast<int>(row)];
        }
    }
    stiffness[3][3] = gyz;
    stiffness[4][4] = gxz;
    stiffness[5][5] = gxy;
    return stiffness;
}

constexpr int kFirst[6] = {0, 1, 2, 1, 0, 0}, kSecond[6] = {0, 1, 2, 2, 2, 1};

/// C'_ijkl = R_ia R_jb R_kc R_ld C_abcd, on the matrices.
Matrix6 turned(const Matrix6& c, const glm::dmat3& r) {
    // K maps the pairs of the material's axes to those of the world; both orders of a shear pair contribute.
    Matrix6 k{};
    for (std::size_t to = 0; to < 6; ++to) {
        for (std::size_t from = 0; from < 6; ++from) {
            const int i = kFirst[to], j = kSecond[to], a = kFirst[from], b = kSecond[from];
            k[to][from] = r[a][i] * r[b][j] + (a != b ? r[b][i] * r[a][j] : 0.0);
        }
    }
    Matrix6 result{};
    for (std::size_t i = 0; i < 6; ++i) {
        for (std::size_t j = 0; j < 6; ++j) {
            for (std::size_t a = 0; a < 6; ++a) {
                for (std::size_t b = 0; b < 6; ++b) result[i][j] += k[i][a] * c[a][b] * k[j][b];
            }
        }
    }
    return result;
}

glm::dmat3 aboutY(double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    return glm::dmat3(c, 0, -s, 0, 1, 0, s, 0, c);
}
glm::dmat3 aboutZ(double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    return glm::dmat3(c, s, 0, -s, c, 0, 0, 0, 1);
}

}  // namespace

StiffnessField stiffnessField(const StiffnessOptions& options) {
    if (options.size < 2 || options.size > 256) {
        throw Error(Code::kInvalidArgument, "size is " + std::to_string(options.size) +
                                                "; a stiffness field has 2 to 256 voxels along its longest edge");
    }
    StiffnessField field;
    field.size = glm::ivec3(options.size, (options.size + 1) / 2, (options.size + 1) / 2);
    const double edge_mm = 48.0 / options.size;
    for (int axis = 0; axis < 3; ++axis) {
        field.voxel_to_world[axis][axis] = edge_mm;
        field.voxel_to_world[3][axis] = -0.5 * edge_mm * (field.size[axis] - 1);
    }
    const Matrix6 laminate = orthotropic(140, 10, 9, 0.3, 0.3, 0.45, 3.4, 4.7, 5.1);
    const double wave = 2 * std::numbers::pi * phantom::uniform(options.seed, 0);
    const double tilt = 2 * std::numbers::pi * phantom::uniform(options.seed, 1);
    for (int z = 0; z < field.size.z; ++z) {
        for (int y = 0; y < field.size.y; ++y) {
            for (int x = 0; x < field.size.x; ++x) {
                const glm::dvec3 p(2.0 * x / (field.size.x - 1) - 1, 2.0 * y / std::max(field.size.y - 1, 1) - 1,
                                   2.0 * z / std::max(field.size.z - 1, 1) - 1);
                // Layers at 0 and 90 degrees, turned smoothly into each other; fibres wave along x.
                const double layer = 0.5 * std::numbers::pi * (0.5 + 0.5 * std::sin(2.5 * p.z + tilt));
                const glm::dmat3 course = aboutZ(layer) * aboutY(0.5 * std::sin(3 * p.x + wave));
                Matrix6 stiffness = turned(laminate, course);
                // The load presses on the middle of the top; damage fades with the distance from it, most of it in z and shear.
                const glm::dvec3 from_load = p - glm::dvec3(0, 0, 1);
                const double damage = 0.75 * std::exp(-2.2 * glm::dot(from_load, from_load));
                const double kept[6] = {1 - 0.3 * damage, 1 - 0.3 * damage, 1 - damage,
                                        1 - damage,       1 - damage,       1 - 0.5 * damage};
                const double voids = 1 - 0.1 * phantom::uniform(options.seed, 2 + field.matrices.size());
                std::array<double, 21>& upper = field.matrices.emplace_back();
                std::size_t next = 0;
                for (std::size_t row = 0; row < 6; ++row) {
                    for (std::size_t column = row; column < 6; ++column) {
                        upper[next++] = voids * std::sqrt(kept[row] * kept[column]) * stiffness[row][column];
                    }
                }
            }
        }
    }
    return field;
}

model::ShImage stiffnessImage(const StiffnessOptions& options) {
    const StiffnessField field = stiffnessField(options);
    const TensorSh map(4);
    model::ShImage image;
    image.size = field.size;
    image.voxel_to_world = field.voxel_to_world;
    image.layout = map.layout();
    image.source = "stiffness";
    image.file_convention = ShConvention::kDescoteaux07;
    image.tensor_order = 4;
    image.tensor_format = "voigt-stiffness";
    std::vector<double> coefficients(image.layout.count());
    for (std::size_t i = 0; i < field.matrices.size(); ++i) {
        const auto at = static_cast<int>(i);
        image.voxels.emplace_back(at % field.size.x, at / field.size.x % field.size.y, at / (field.size.x * field.size.y));
        const std::vector<double> components =
            symmetricFromMatrix(fullMatrix(field.matrices[i]), ElasticityConvention::kVoigtStiffness);
        map.toSh(components, coefficients);
        for (const double value : components) image.tensors.push_back(static_cast<float>(value));
        for (const double value : coefficients) image.coefficients.push_back(static_cast<float>(value));
    }
    return image;
}

}  // namespace radiata
