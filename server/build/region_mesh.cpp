#include "build/region_mesh.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

#include "base/error.h"

namespace radiata {
namespace {

struct Box {
    glm::dvec3 low{1e300}, high{-1e300};
    void add(const glm::dvec3& p) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    void add(const Box& other) {
        low = glm::min(low, other.low);
        high = glm::max(high, other.high);
    }
    bool touches(const glm::dvec3& l, const glm::dvec3& h) const {
        return glm::all(glm::lessThanEqual(low, h)) && glm::all(glm::lessThanEqual(l, high));
    }
};

using Triangle = std::array<glm::dvec3, 3>;

/// Twice the signed area of (p, a, b) in the y-z plane; exactly opposite for (p, b, a).
double turn(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
    return (a.y - p.y) * (b.z - p.z) - (b.y - p.y) * (a.z - p.z);
}

/// Whether p is on the left of the edge from a to b; points on the edge belong to one of its two directions.
bool leftOf(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
    const double side = turn(p, a, b);
    if (side != 0) return side > 0;
    return a.z != b.z ? a.z < b.z : a.y < b.y;
}

/// Whether the ray from p along +x crosses the triangle. Of triangles that share an edge or a corner in the y-z plane one has
/// it, so a closed surface is crossed an even number of times by a whole line.
bool crosses(const glm::dvec3& p, const Triangle& t) {
    const bool s0 = leftOf(p, t[0], t[1]), s1 = leftOf(p, t[1], t[2]), s2 = leftOf(p, t[2], t[0]);
    if (s0 != s1 || s1 != s2) return false;
    const double w0 = turn(p, t[1], t[2]), w1 = turn(p, t[2], t[0]), w2 = turn(p, t[0], t[1]), sum = w0 + w1 + w2;
    if (sum == 0) return false;
    return (w0 * t[0].x + w1 * t[1].x + w2 * t[2].x) / sum > p.x;
}

double volume(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d) {
    return glm::dot(a - d, glm::cross(b - d, c - d));
}

/// Whether a segment touches a triangle, its rim included; segments in the triangle's plane do not count.
bool meetsTriangle(const glm::dvec3& a, const glm::dvec3& b, const Triangle& t) {
    const double from = volume(t[0], t[1], t[2], a), to = volume(t[0], t[1], t[2], b);
    if ((from > 0 && to > 0) || (from < 0 && to < 0) || (from == 0 && to == 0)) return false;
    const double u = volume(a, b, t[0], t[1]), v = volume(a, b, t[1], t[2]), w = volume(a, b, t[2], t[0]);
    return (u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0);
}

class MeshVolume : public RegionVolume {
public:
    explicit MeshVolume(const model::TriangleMesh& mesh) {
        for (const glm::uvec3& t : mesh.triangles) {
            triangles_.push_back({glm::dvec3(mesh.points[t.x]), glm::dvec3(mesh.points[t.y]), glm::dvec3(mesh.points[t.z])});
        }
        build(0, triangles_.size());
    }

    BoxRelation relate(const glm::dvec3& low, const glm::dvec3& high) const override {
        const bool near = any([&](const Box& box) { return box.touches(low, high); },
                              [&](const Triangle& t) {
                                  Box box;
                                  for (const glm::dvec3& p : t) box.add(p);
                                  return box.touches(low, high);
                              });
        if (near) return BoxRelation::kUnknown;
        return contains(0.5 * (low + high)) ? BoxRelation::kInside : BoxRelation::kOutside;
    }

    bool contains(const glm::dvec3& p) const override {
        bool inside = false;
        any(
            [&](const Box& box) {
                return box.touches(p, {1e300, p.y, p.z});
            },
            [&](const Triangle& t) {
                if (crosses(p, t)) inside = !inside;
                return false;
            });
        return inside;
    }

    bool meets(const glm::dvec3& a, const glm::dvec3& b) const override { return contains(a) || touches(a, b); }
    bool holds(const glm::dvec3& a, const glm::dvec3& b) const override { return contains(a) && !touches(a, b); }

private:
    struct Node {
        Box box;
        std::size_t first = 0, count = 0;  ///< triangles of a leaf
        std::size_t right = 0;             ///< of an inner node, whose left child is the next node
    };

    static glm::dvec3 centre(const Triangle& t) { return (t[0] + t[1] + t[2]) / 3.0; }

    /// Halves by the median along the longest axis of the centres.
    std::size_t build(std::size_t first, std::size_t end) {
        const std::size_t index = nodes_.size();
        nodes_.emplace_back();
        Box box, centres;
        for (std::size_t i = first; i < end; ++i) {
            for (const glm::dvec3& p : triangles_[i]) box.add(p);
            centres.add(centre(triangles_[i]));
        }
        nodes_[index].box = box;
        if (end - first <= 4) {
            nodes_[index].first = first;
            nodes_[index].count = end - first;
            return index;
        }
        const glm::dvec3 extent = centres.high - centres.low;
        const int axis = extent.x >= extent.y ? (extent.x >= extent.z ? 0 : 2) : (extent.y >= extent.z ? 1 : 2);
        const std::size_t middle = (first + end) / 2;
        const auto at = [&](std::size_t i) { return triangles_.begin() + static_cast<std::ptrdiff_t>(i); };
        std::nth_element(at(first), at(middle), at(end),
                         [axis](const Triangle& a, const Triangle& b) { return centre(a)[axis] < centre(b)[axis]; });
        build(first, middle);
        const std::size_t right = build(middle, end);
        nodes_[index].right = right;
        return index;
    }

    /// Visits triangles in boxes that `wanted` takes, until `found` says so. \return whether it did
    template <typename Wanted, typename Found>
    bool any(Wanted&& wanted, Found&& found) const {
        std::array<std::size_t, 64> stack;
        std::size_t depth = 0;
        stack[depth++] = 0;
        while (depth > 0) {
            const std::size_t index = stack[--depth];
            const Node& node = nodes_[index];
            if (!wanted(node.box)) continue;
            for (std::size_t i = node.first; i < node.first + node.count; ++i) {
                if (found(triangles_[i])) return true;
            }
            if (node.count > 0) continue;
            stack[depth++] = node.right;
            stack[depth++] = index + 1;
        }
        return false;
    }

    bool touches(const glm::dvec3& a, const glm::dvec3& b) const {
        const glm::dvec3 low = glm::min(a, b), high = glm::max(a, b);
        return any([&](const Box& box) { return box.touches(low, high); },
                   [&](const Triangle& t) { return meetsTriangle(a, b, t); });
    }

    std::vector<Triangle> triangles_;
    std::vector<Node> nodes_;
};

/// Edges that an odd number of triangles have.
std::size_t openEdges(const model::TriangleMesh& mesh) {
    std::vector<std::uint64_t> edges;
    for (const glm::uvec3& t : mesh.triangles) {
        for (int i = 0; i < 3; ++i) {
            const std::uint64_t a = t[i], b = t[(i + 1) % 3];
            edges.push_back(std::min(a, b) << 32 | std::max(a, b));
        }
    }
    std::ranges::sort(edges);
    std::size_t open = 0;
    for (std::size_t i = 0; i < edges.size();) {
        std::size_t end = i;
        while (end < edges.size() && edges[end] == edges[i]) ++end;
        open += (end - i) % 2;
        i = end;
    }
    return open;
}

}  // namespace

std::unique_ptr<RegionVolume> meshVolume(const model::TriangleMesh& mesh) {
    if (mesh.triangles.empty())
        throw Error(Code::kInvalidArgument, mesh.source + " has no triangles, so nothing is inside of it");
    if (const std::size_t open = openEdges(mesh); open > 0) {
        throw Error(Code::kInvalidArgument, mesh.source + " is open: " + std::to_string(open) +
                                                " edges belong to an odd number of triangles; regions need closed surfaces");
    }
    return std::make_unique<MeshVolume>(mesh);
}

}  // namespace radiata
