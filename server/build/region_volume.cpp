#include "build/region_volume.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "build/region_mesh.h"

namespace radiata {
namespace {

std::array<glm::dvec3, 8> cornersOf(const glm::dvec3& low, const glm::dvec3& high) {
    std::array<glm::dvec3, 8> corners;
    for (std::size_t i = 0; i < 8; ++i) {
        corners[i] = {(i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y, (i & 4) != 0 ? high.z : low.z};
    }
    return corners;
}

/// The inverse, column by column scaled, so that axes of any lengths that doubles have neither over- nor underflow. A length
/// below 1e-300 mm is no other region than that.
glm::dmat3 inverseOf(const glm::dmat3& axes) {
    glm::dmat3 units;
    glm::dvec3 lengths;
    for (int i = 0; i < 3; ++i) {
        lengths[i] = std::max(std::hypot(axes[i].x, axes[i].y, axes[i].z), 1e-300);
        units[i] = axes[i] / lengths[i];
    }
    const glm::dmat3 inverse = glm::inverse(units);
    glm::dmat3 scaled;
    for (int column = 0; column < 3; ++column) scaled[column] = inverse[column] / lengths;
    return scaled;
}

double largestPart(const glm::dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

/// Convex regions hold a box or a segment if they hold its corners or ends.
class Convex : public RegionVolume {
public:
    BoxRelation relate(const glm::dvec3& low, const glm::dvec3& high) const final {
        if (apart(low, high)) return BoxRelation::kOutside;
        const auto corners = cornersOf(low, high);
        const bool all = std::all_of(corners.begin(), corners.end(), [this](const glm::dvec3& p) { return contains(p); });
        return all ? BoxRelation::kInside : BoxRelation::kUnknown;
    }
    bool holds(const glm::dvec3& a, const glm::dvec3& b) const final { return contains(a) && contains(b); }

protected:
    virtual bool apart(const glm::dvec3& low, const glm::dvec3& high) const = 0;
};

class Ellipsoid : public Convex {
public:
    explicit Ellipsoid(const model::FibreRegion& region) : centre_(region.centre), to_ball_(inverseOf(region.axes)) {
        for (int i = 0; i < 3; ++i) {
            half_[i] = std::hypot(region.axes[0][i], region.axes[1][i], region.axes[2][i]);
        }
    }

    bool contains(const glm::dvec3& p) const override {
        const glm::dvec3 q = to_ball_ * (p - centre_);
        return glm::dot(q, q) <= 1;
    }

    bool meets(const glm::dvec3& a, const glm::dvec3& b) const override {
        const glm::dvec3 q = to_ball_ * (a - centre_), d = to_ball_ * (b - a);
        // In units of d, whose square a large or small ellipsoid would make 0 or infinite.
        const double unit = largestPart(d);
        const glm::dvec3 direction = unit > 0 ? d / unit : d;
        const double t = unit > 0 ? std::clamp(-glm::dot(q / unit, direction) / glm::dot(direction, direction), 0.0, 1.0) : 0;
        const glm::dvec3 nearest = q + t * d;
        return glm::dot(nearest, nearest) <= 1;
    }

protected:
    bool apart(const glm::dvec3& low, const glm::dvec3& high) const override {
        for (int i = 0; i < 3; ++i) {
            if (low[i] > centre_[i] + half_[i] || high[i] < centre_[i] - half_[i]) return true;
        }
        // A ball around the box in the space where the ellipsoid is the unit ball.
        const glm::dvec3 q = to_ball_ * (0.5 * (low + high) - centre_), h = 0.5 * (high - low);
        double reach = 0;
        for (int i = 0; i < 8; i += 2) {
            const glm::dvec3 corner((i & 2) != 0 ? h.x : -h.x, (i & 4) != 0 ? h.y : -h.y, h.z);
            reach = std::max(reach, glm::length(to_ball_ * corner));
        }
        return glm::length(q) > 1 + reach;
    }

private:
    glm::dvec3 centre_, half_{0};
    glm::dmat3 to_ball_;
};

class Box : public Convex {
public:
    explicit Box(const model::FibreRegion& region) : low_(region.centre), high_(region.high) {}

    bool contains(const glm::dvec3& p) const override {
        return p.x >= low_.x && p.y >= low_.y && p.z >= low_.z && p.x <= high_.x && p.y <= high_.y && p.z <= high_.z;
    }

    bool meets(const glm::dvec3& a, const glm::dvec3& b) const override {
        double enter = 0, leave = 1;
        for (int i = 0; i < 3; ++i) {
            const double d = b[i] - a[i];
            if (d == 0) {
                if (a[i] < low_[i] || a[i] > high_[i]) return false;
                continue;
            }
            const double t0 = (low_[i] - a[i]) / d, t1 = (high_[i] - a[i]) / d;
            enter = std::max(enter, std::min(t0, t1));
            leave = std::min(leave, std::max(t0, t1));
        }
        return enter <= leave;
    }

protected:
    bool apart(const glm::dvec3& low, const glm::dvec3& high) const override {
        return low.x > high_.x || low.y > high_.y || low.z > high_.z || high.x < low_.x || high.y < low_.y || high.z < low_.z;
    }

private:
    glm::dvec3 low_, high_;
};

class HalfSpace : public Convex {
public:
    explicit HalfSpace(const model::FibreRegion& region)
        : point_(region.centre), normal_(glm::normalize(region.high / largestPart(region.high))) {}

    bool contains(const glm::dvec3& p) const override { return glm::dot(p - point_, normal_) <= 0; }
    bool meets(const glm::dvec3& a, const glm::dvec3& b) const override { return contains(a) || contains(b); }

protected:
    bool apart(const glm::dvec3& low, const glm::dvec3& high) const override {
        // The corner that lies deepest.
        const glm::dvec3 deepest(normal_.x > 0 ? low.x : high.x, normal_.y > 0 ? low.y : high.y,
                                 normal_.z > 0 ? low.z : high.z);
        return !contains(deepest);
    }

private:
    glm::dvec3 point_, normal_;
};

}  // namespace

std::unique_ptr<RegionVolume> regionVolume(const model::FibreRegion& region, const MaskLookup& masks,
                                           const MeshLookup& meshes) {
    switch (region.shape) {
        case model::RegionShape::kBox:
            return std::make_unique<Box>(region);
        case model::RegionShape::kHalfSpace:
            return std::make_unique<HalfSpace>(region);
        case model::RegionShape::kMesh:
            return meshVolume(*meshes(region.dataset));
        case model::RegionShape::kMask:
            return maskVolume(*masks(region.dataset), region.threshold);
        case model::RegionShape::kEllipsoid:
            break;
    }
    return std::make_unique<Ellipsoid>(region);
}

}  // namespace radiata
