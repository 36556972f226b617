// The region of a mask's voxels: a table of sums answers boxes, a walk from voxel to voxel segments.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "build/region_volume.h"

namespace radiata {
namespace {

class Mask : public RegionVolume {
public:
    Mask(const model::ScalarImage& image, double threshold)
        : size_(image.size), to_voxel_(glm::inverse(image.voxel_to_world)), sums_(count(image.size + 1)) {
        const glm::ivec3 n = size_ + 1;
        set_.resize(count(size_));
        for (int k = 0; k < size_.z; ++k) {
            for (int j = 0; j < size_.y; ++j) {
                std::uint32_t row = 0;
                for (int i = 0; i < size_.x; ++i) {
                    const bool in = image.at({i, j, k}) > threshold;
                    set_[index({i, j, k}, size_)] = in;
                    row += in ? 1 : 0;
                    const std::uint32_t before = sums_[index({i + 1, j, k + 1}, n)] + sums_[index({i + 1, j + 1, k}, n)] -
                                                 sums_[index({i + 1, j, k}, n)];
                    sums_[index({i + 1, j + 1, k + 1}, n)] = before + row;
                }
            }
        }
    }

    BoxRelation relate(const glm::dvec3& low, const glm::dvec3& high) const override {
        const glm::dvec3 centre = voxel(0.5 * (low + high)), h = 0.5 * (high - low);
        glm::dvec3 reach(1e-9);
        for (int c = 0; c < 3; ++c) reach += glm::abs(glm::dvec3(to_voxel_[c])) * h[c];
        const glm::dvec3 first = glm::floor(centre - reach + 0.5), last = glm::floor(centre + reach + 0.5);
        const glm::ivec3 from(glm::clamp(first, glm::dvec3(0), glm::dvec3(size_)));
        const glm::ivec3 to(glm::clamp(last + 1.0, glm::dvec3(0), glm::dvec3(size_)));
        if (glm::any(glm::greaterThanEqual(from, to))) return BoxRelation::kOutside;
        const std::uint32_t in = sum(from, to);
        if (in == 0) return BoxRelation::kOutside;
        const glm::dvec3 extent = last - first + 1.0;
        return in == extent.x * extent.y * extent.z ? BoxRelation::kInside : BoxRelation::kUnknown;
    }

    bool contains(const glm::dvec3& p) const override { return at(voxel(p)); }

    bool meets(const glm::dvec3& a, const glm::dvec3& b) const override {
        return walk(a, b, [](bool in) { return in; });
    }
    bool holds(const glm::dvec3& a, const glm::dvec3& b) const override {
        return !walk(a, b, [](bool in) { return !in; });
    }

private:
    static std::size_t count(const glm::ivec3& n) {
        return static_cast<std::size_t>(n.x) * static_cast<std::size_t>(n.y) * static_cast<std::size_t>(n.z);
    }
    static std::size_t index(const glm::ivec3& v, const glm::ivec3& n) {
        return static_cast<std::size_t>(v.x) +
               static_cast<std::size_t>(n.x) *
                   (static_cast<std::size_t>(v.y) + static_cast<std::size_t>(n.y) * static_cast<std::size_t>(v.z));
    }
    glm::dvec3 voxel(const glm::dvec3& p) const { return glm::dvec3(to_voxel_ * glm::dvec4(p, 1)); }
    bool at(const glm::dvec3& v) const {
        const glm::dvec3 cell = glm::floor(v + 0.5);
        for (int i = 0; i < 3; ++i) {
            if (!(cell[i] >= 0 && cell[i] < size_[i])) return false;
        }
        return set_[index(glm::ivec3(cell), size_)];
    }
    std::uint32_t sum(const glm::ivec3& from, const glm::ivec3& to) const {
        const glm::ivec3 n = size_ + 1;
        std::uint32_t total = 0;
        for (int c = 0; c < 8; ++c) {
            const glm::ivec3 corner((c & 1) != 0 ? to.x : from.x, (c & 2) != 0 ? to.y : from.y, (c & 4) != 0 ? to.z : from.z);
            const int lows = 3 - ((c & 1) + (c >> 1 & 1) + (c >> 2));
            total += lows % 2 == 0 ? sums_[index(corner, n)] : 0U - sums_[index(corner, n)];
        }
        return total;
    }

    /// Visits the voxels that a segment passes until `stop` says so. \return whether it did
    template <typename Stop>
    bool walk(const glm::dvec3& a_world, const glm::dvec3& b_world, Stop&& stop) const {
        const glm::dvec3 a = voxel(a_world) + 0.5, d = voxel(b_world) + 0.5 - a;
        glm::dvec3 cell = glm::floor(a), next, each;
        const glm::dvec3 last = glm::floor(a + d);
        glm::dvec3 step;
        for (int i = 0; i < 3; ++i) {
            step[i] = d[i] > 0 ? 1 : -1;
            each[i] = d[i] != 0 ? std::abs(1 / d[i]) : HUGE_VAL;
            next[i] = d[i] != 0 ? (cell[i] + (d[i] > 0 ? 1 : 0) - a[i]) / d[i] : HUGE_VAL;
        }
        const glm::dvec3 way = glm::abs(last - cell);
        // A segment far longer than the grid is cut to it by its own count of crossings.
        const double crossings = std::min(way.x + way.y + way.z, 1e7);
        for (double done = 0;; ++done) {
            if (stop(at(cell - 0.5 + 0.5))) return true;
            if (done >= crossings) return false;
            const int axis = next.x <= next.y ? (next.x <= next.z ? 0 : 2) : (next.y <= next.z ? 1 : 2);
            cell[axis] += step[axis];
            next[axis] += each[axis];
        }
    }

    glm::ivec3 size_;
    glm::dmat4 to_voxel_;
    std::vector<bool> set_;
    std::vector<std::uint32_t> sums_;  ///< of all voxels below a corner
};

}  // namespace

std::unique_ptr<RegionVolume> maskVolume(const model::ScalarImage& image, double threshold) {
    return std::make_unique<Mask>(image, threshold);
}

}  // namespace radiata
