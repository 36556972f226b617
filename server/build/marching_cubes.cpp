#include "build/marching_cubes.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "base/error.h"
#include "build/volume_bricks.h"

namespace radiata {
namespace {

/// The edge between two corners that differ in one coordinate.
int edgeBetween(unsigned a, unsigned b) {
    const unsigned bit = a ^ b;
    const int axis = bit == 1 ? 0 : bit == 2 ? 1 : 2;
    const unsigned at = a & b;
    return 4 * axis + static_cast<int>((at >> ((axis + 1) % 3) & 1U) | (at >> ((axis + 2) % 3) & 1U) << 1U);
}

/// Corners of a face, counterclockwise seen from outside of the cube.
std::array<unsigned, 4> faceCorners(int face) {
    const int axis = face / 2;
    const unsigned far = face % 2 ? 1U << axis : 0U, u = 1U << ((axis + 1) % 3), v = 1U << ((axis + 2) % 3);
    if (face % 2) return {far, far | u, far | u | v, far | v};
    return {far, far | v, far | u | v, far | u};
}

/// For each crossed edge that a face's contour comes from, the edge that it goes to; -1 elsewhere. Each edge belongs to two
/// faces and is left on one and entered on the other, so the pieces of all faces form loops.
std::array<int, 12> contours(unsigned inside) {
    std::array<int, 12> next{};
    next.fill(-1);
    for (int face = 0; face < 6; ++face) {
        const auto corners = faceCorners(face);
        const auto in = [&](std::size_t n) { return (inside >> corners[n % 4] & 1U) != 0; };
        for (std::size_t first = 0; first < 4; ++first) {
            if (!in(first) || in(first + 3)) continue;
            // A run of corners inside begins here; the contour cuts it off.
            std::size_t last = first;
            while (in(last + 1)) ++last;
            next[static_cast<std::size_t>(edgeBetween(corners[(first + 3) % 4], corners[first]))] =
                edgeBetween(corners[last % 4], corners[(last + 1) % 4]);
        }
    }
    return next;
}

class Extraction {
public:
    Extraction(const model::ScalarImage& image, float isovalue) : image_(image), isovalue_(isovalue) {
        for (unsigned n = 0; n < 256; ++n) loops_[n] = cubeLoops(n);
        const auto plane = static_cast<std::size_t>(image.size.x) * static_cast<std::size_t>(image.size.y);
        for (auto& layer : edges_) layer.assign(3 * plane, 0);
    }

    SurfaceMesh run() {
        for (int k = 0; k < image_.size.z - 1; ++k) {
            // Crossings of the upper plane become those of the lower one.
            std::swap(edges_[0], edges_[1]);
            std::ranges::fill(edges_[1], 0U);
            for (int j = 0; j < image_.size.y - 1; ++j) {
                for (int i = 0; i < image_.size.x - 1; ++i) addCell({i, j, k});
            }
        }
        return std::move(mesh_);
    }

private:
    void addCell(const glm::ivec3& cell) {
        unsigned inside = 0;
        for (unsigned n = 0; n < 8; ++n) {
            const float value = image_.at(cell + glm::ivec3(n & 1U, n >> 1U & 1U, n >> 2U));
            if (!hasValue(value)) return;
            if (value >= isovalue_) inside |= 1U << n;
        }
        if (inside == 0 || inside == 255) return;
        for (const std::vector<int>& loop : loops_[inside]) {
            const std::uint32_t first = vertex(cell, loop[0]);
            for (std::size_t n = 1; n + 1 < loop.size(); ++n) {
                mesh_.triangles.insert(mesh_.triangles.end(), {first, vertex(cell, loop[n]), vertex(cell, loop[n + 1])});
            }
        }
    }

    std::uint32_t vertex(const glm::ivec3& cell, int edge) {
        const int axis = edge / 4, u = (axis + 1) % 3, v = (axis + 2) % 3;
        glm::ivec3 from = cell;
        from[u] += edge & 1;
        from[v] += edge >> 1 & 1;
        const auto at = static_cast<std::size_t>(3 * (from.x + image_.size.x * from.y) + axis);
        std::uint32_t& known = edges_[static_cast<std::size_t>(from.z - cell.z)][at];
        if (known == 0) {
            if (mesh_.positions.size() >= (std::size_t{1} << 31)) {
                throw Error(Code::kResourceExhausted, image_.source + ": the isosurface has more than 2147483648 corners");
            }
            glm::ivec3 to = from;
            ++to[axis];
            const float a = image_.at(from), b = image_.at(to), share = (isovalue_ - a) / (b - a);
            mesh_.positions.push_back(glm::mix(glm::vec3(from), glm::vec3(to), share));
            const glm::vec3 slope = glm::mix(gradient(from), gradient(to), share);
            const float size = glm::length(slope);
            mesh_.normals.push_back(size > 0 ? -slope / size : glm::vec3(0, 0, 1));
            known = static_cast<std::uint32_t>(mesh_.positions.size());
        }
        return known - 1;
    }

    /// Central differences, one-sided at the border and beside voxels without a number.
    glm::vec3 gradient(const glm::ivec3& v) const {
        glm::vec3 result;
        for (int axis = 0; axis < 3; ++axis) {
            glm::ivec3 low = v, high = v;
            low[axis] = std::max(v[axis] - 1, 0);
            high[axis] = std::min(v[axis] + 1, image_.size[axis] - 1);
            if (!hasValue(image_.at(low))) low = v;
            if (!hasValue(image_.at(high))) high = v;
            const int apart = high[axis] - low[axis];
            result[axis] = apart > 0 ? (image_.at(high) - image_.at(low)) / static_cast<float>(apart) : 0;
        }
        return result;
    }

    const model::ScalarImage& image_;
    float isovalue_;
    std::array<std::vector<std::vector<int>>, 256> loops_;
    /// Vertices on the edges that begin on the cells' lower and upper plane, plus 1; 0: none yet.
    std::array<std::vector<std::uint32_t>, 2> edges_;
    SurfaceMesh mesh_;
};

}  // namespace

std::vector<std::vector<int>> cubeLoops(unsigned inside) {
    std::array<int, 12> next = contours(inside);
    std::vector<std::vector<int>> loops;
    for (int begin = 0; begin < 12; ++begin) {
        std::vector<int> loop;
        for (int edge = begin; next[static_cast<std::size_t>(edge)] >= 0;) {
            loop.push_back(edge);
            edge = std::exchange(next[static_cast<std::size_t>(edge)], -1);
        }
        if (!loop.empty()) loops.push_back(std::move(loop));
    }
    return loops;
}

SurfaceMesh marchCubes(const model::ScalarImage& image, float isovalue) {
    if (glm::any(glm::lessThan(image.size, glm::ivec3(2)))) {
        throw Error(Code::kInvalidArgument, image.source + ": an isosurface needs at least 2 samples along each axis");
    }
    return Extraction(image, isovalue).run();
}

}  // namespace radiata
