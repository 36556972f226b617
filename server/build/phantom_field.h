// Which bundles fill a point of the test brain, and how they run there.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "build/phantom_bundles.h"

namespace radiata::phantom {

struct BundleSample {
    int id = kNoBundle;
    double fraction = 0;    ///< of the volume; the sum over a point's bundles is at most 1
    glm::dvec3 tangent{0};  ///< unit, world
};

/// At most this many bundles meet in a point; the weakest of more would be left out.
constexpr std::size_t kBundlesMax = 7;

struct FieldSample {
    std::array<BundleSample, kBundlesMax> bundles;
    std::size_t count = 0;
    double total() const {
        double sum = 0;
        for (std::size_t i = 0; i < count; ++i) sum += bundles[i].fraction;
        return sum;
    }
};

/// The bundles with an index over space. Immutable after construction; sample() may run on many threads.
class BundleField {
public:
    explicit BundleField(std::vector<Bundle> bundles);

    const std::vector<Bundle>& bundles() const { return bundles_; }
    /// A bundle fills a point by its fraction times 1 within half a strand's radius of a centre line, smoothly less up to the
    /// radius, nothing beyond; its tangent is the mean of its strands' tangents there, weighted likewise. \param p_world  mm
    FieldSample sample(const glm::dvec3& p_world) const;

private:
    struct Segment {
        std::uint16_t bundle, strand, point;
    };
    std::size_t cell(const glm::ivec3& index) const {
        return static_cast<std::size_t>((index.z * cells_.y + index.y) * cells_.x + index.x);
    }
    glm::ivec3 cellOf(const glm::dvec3& p_world) const;

    std::vector<Bundle> bundles_;
    glm::dvec3 origin_mm_{0};
    glm::ivec3 cells_{0};
    std::vector<std::vector<Segment>> segments_;  // per cell, those that reach into it, in order
};

}  // namespace radiata::phantom
