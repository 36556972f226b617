// The hierarchy holds every box once, and a walk through it finds what testing every box finds: exactly, no tolerance.
#include "build/bvh.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <optional>
#include <random>

#include <gtest/gtest.h>

#include "base/error.h"

namespace radiata {
namespace {

using shader::BvhNode;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

struct Boxes {
    std::vector<glm::vec3> mins;
    std::vector<glm::vec3> maxs;

    void add(const glm::vec3& min, const glm::vec3& max) {
        mins.push_back(min);
        maxs.push_back(max);
    }
};

struct Ray {
    glm::vec3 origin;
    glm::vec3 inverse;
};

/// Where a ray enters a box, if it does before `limit`. Rays here have no zero direction component.
std::optional<float> entry(const Ray& ray, const glm::vec3& min, const glm::vec3& max, float limit) {
    const glm::vec3 a = (min - ray.origin) * ray.inverse;
    const glm::vec3 b = (max - ray.origin) * ray.inverse;
    const glm::vec3 low = glm::min(a, b);
    const glm::vec3 high = glm::max(a, b);
    const float near = std::max({low.x, low.y, low.z, 0.0F});
    const float far = std::min({high.x, high.y, high.z, limit});
    if (near > far) return std::nullopt;
    return near;
}

struct Hit {
    float distance = kInfinity;
    std::uint32_t primitive = ~0U;

    bool operator==(const Hit&) const = default;
    void offer(float at, std::uint32_t who) {
        if (at < distance || (at == distance && who < primitive)) *this = {at, who};
    }
};

Hit nearestOfAll(const Boxes& boxes, const Ray& ray) {
    Hit hit;
    for (std::uint32_t i = 0; i < boxes.mins.size(); ++i) {
        if (const auto at = entry(ray, boxes.mins[i], boxes.maxs[i], kInfinity)) hit.offer(*at, i);
    }
    return hit;
}

/// The walk of a compute shader, nearer child first, with a stack of fixed size.
Hit nearestByWalk(const Bvh& bvh, const Boxes& boxes, const Ray& ray, std::size_t& visited) {
    Hit hit;
    std::uint32_t stack[shader::BVH_DEPTH_MAX];
    std::size_t height = 0;
    std::uint32_t index = 0;
    const auto leaf = [&](std::uint32_t first, std::uint32_t count) {
        for (std::uint32_t i = first; i < first + count; ++i) {
            const std::uint32_t who = bvh.order[i];
            if (const auto at = entry(ray, boxes.mins[who], boxes.maxs[who], kInfinity)) hit.offer(*at, who);
        }
    };
    for (;;) {
        ++visited;
        const BvhNode& node = bvh.nodes[index];
        std::optional<float> at0 = entry(ray, node.min0, node.max0, hit.distance);
        std::optional<float> at1 = entry(ray, node.min1, node.max1, hit.distance);
        if (at0 && node.count0 != shader::BVH_INNER) {
            leaf(node.index0, node.count0);
            at0.reset();
        }
        if (at1 && node.count1 != shader::BVH_INNER) {
            leaf(node.index1, node.count1);
            at1.reset();
        }
        if (at0 && at1) {
            const bool swap = *at1 < *at0;
            EXPECT_LT(height, shader::BVH_DEPTH_MAX);
            stack[height++] = swap ? node.index0 : node.index1;
            index = swap ? node.index1 : node.index0;
        } else if (at0 || at1) {
            index = at0 ? node.index0 : node.index1;
        } else if (height > 0) {
            index = stack[--height];
        } else {
            return hit;
        }
    }
}

struct Shape {
    std::vector<int> seen;  ///< leaves that hold each primitive
    std::size_t depth = 0;
    std::size_t nodes = 0;
};

void inspect(const Bvh& bvh, const Boxes& boxes, std::uint32_t index, std::size_t depth, const glm::vec3& min,
             const glm::vec3& max, Shape& shape) {
    ASSERT_LT(index, bvh.nodes.size());
    ++shape.nodes;
    shape.depth = std::max(shape.depth, depth);
    const BvhNode& node = bvh.nodes[index];
    const auto child = [&](const glm::vec3& low, const glm::vec3& high, std::uint32_t first, std::uint32_t count) {
        if (count == 0) return;
        ASSERT_TRUE(glm::all(glm::lessThanEqual(min, low)) && glm::all(glm::lessThanEqual(high, max)));
        if (count == shader::BVH_INNER) return inspect(bvh, boxes, first, depth + 1, low, high, shape);
        ASSERT_LE(count, shader::BVH_LEAF_MAX);
        ASSERT_LE(first + count, bvh.order.size());
        for (std::uint32_t i = first; i < first + count; ++i) {
            const std::uint32_t who = bvh.order[i];
            ASSERT_LT(who, boxes.mins.size());
            ++shape.seen[who];
            ASSERT_TRUE(glm::all(glm::lessThanEqual(low, boxes.mins[who]))) << who;
            ASSERT_TRUE(glm::all(glm::lessThanEqual(boxes.maxs[who], high))) << who;
        }
    };
    child(node.min0, node.max0, node.index0, node.count0);
    child(node.min1, node.max1, node.index1, node.count1);
}

Shape inspected(const Bvh& bvh, const Boxes& boxes) {
    Shape shape;
    shape.seen.resize(boxes.mins.size());
    inspect(bvh, boxes, 0, 1, bvh.min, bvh.max, shape);
    EXPECT_TRUE(std::ranges::all_of(shape.seen, [](int count) { return count == 1; }));
    EXPECT_EQ(bvh.order.size(), boxes.mins.size());
    EXPECT_LE(shape.depth, shader::BVH_DEPTH_MAX);
    EXPECT_EQ(shape.nodes, bvh.nodes.size()) << "every node is reached once";
    return shape;
}

/// Inspects the hierarchy and compares `rays` random rays with the test of every box; returns nodes visited per ray.
double expectSameHits(const Boxes& boxes, int rays) {
    const Bvh bvh = buildBvh(boxes.mins, boxes.maxs);
    inspected(bvh, boxes);
    std::mt19937 random(11);
    std::normal_distribution<float> normal;
    std::uniform_int_distribution<std::size_t> any(0, boxes.mins.size() - 1);
    const glm::vec3 size = bvh.max - bvh.min + glm::vec3(1e-3F);
    std::size_t visited = 0;
    int hits = 0;
    for (int i = 0; i < rays; ++i) {
        const glm::vec3 outside(normal(random), normal(random), normal(random));
        const std::size_t aim = any(random);
        const glm::vec3 target = 0.5F * (boxes.mins[aim] + boxes.maxs[aim]);
        const glm::vec3 origin = 0.5F * (bvh.min + bvh.max) + outside * size;
        const Ray ray{origin, 1.0F / (target - origin)};
        const Hit expected = nearestOfAll(boxes, ray);
        hits += expected.primitive != ~0U;
        EXPECT_EQ(nearestByWalk(bvh, boxes, ray, visited), expected) << "ray " << i;
    }
    EXPECT_GT(hits, rays / 2);
    return static_cast<double>(visited) / rays;
}

Boxes randomBoxes(std::size_t count, float spread, float size, const glm::vec3& flatten = glm::vec3(1)) {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> unit(0, 1);
    Boxes boxes;
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3 min = spread * glm::vec3(unit(random), unit(random), unit(random)) * flatten;
        boxes.add(min, min + size * glm::vec3(unit(random), unit(random), unit(random)) * flatten);
    }
    return boxes;
}

TEST(Bvh, FindsTheSameHitsInRandomBoxes) {
    const double visited = expectSameHits(randomBoxes(3000, 100, 2), 500);
    EXPECT_LT(visited, 150) << "of about 1500 nodes";
}

TEST(Bvh, FindsTheSameHitsInOverlappingBoxes) { expectSameHits(randomBoxes(500, 1, 50), 300); }

TEST(Bvh, FindsTheSameHitsInClustersOfAllSizes) {
    Boxes boxes;
    float scale = 1e-4F;
    for (int cluster = 0; cluster < 9; ++cluster, scale *= 10) {
        const Boxes part = randomBoxes(150, scale, 0.05F * scale);
        for (std::size_t i = 0; i < part.mins.size(); ++i) boxes.add(part.mins[i] + scale, part.maxs[i] + scale);
    }
    expectSameHits(boxes, 500);
}

TEST(Bvh, FindsTheSameHitsInIdenticalBoxes) {
    Boxes boxes;
    for (int i = 0; i < 1000; ++i) boxes.add({1, 2, 3}, {4, 5, 6});
    expectSameHits(boxes, 100);
    EXPECT_LE(inspected(buildBvh(boxes.mins, boxes.maxs), boxes).depth, 10U);
}

TEST(Bvh, FindsTheSameHitsInFlatBoxes) {
    expectSameHits(randomBoxes(2000, 100, 3, {1, 1, 0}), 300);
    expectSameHits(randomBoxes(2000, 100, 3, {0, 1, 0}), 300);
    expectSameHits(randomBoxes(2000, 100, 0), 300);
}

TEST(Bvh, StaysShallowWhereEverySplitCutsOffOneBox) {
    Boxes boxes;
    float at = 1e-30F;
    for (int i = 0; i < 120; ++i, at *= 3.5F) boxes.add({at, at, at}, {1.1F * at, 1.1F * at, 1.1F * at});
    for (int i = 0; i < 100'000; ++i) boxes.add({0, 0, 0}, {1e-30F, 1e-30F, 1e-30F});
    const Shape shape = inspected(buildBvh(boxes.mins, boxes.maxs), boxes);
    EXPECT_GT(shape.depth, 20U);
}

TEST(Bvh, IsBalancedForPointsOnALine) {
    Boxes boxes;
    for (int i = 0; i < 4096; ++i) boxes.add(glm::vec3(static_cast<float>(i), 0, 0), glm::vec3(static_cast<float>(i), 0, 0));
    EXPECT_LE(inspected(buildBvh(boxes.mins, boxes.maxs), boxes).depth, 13U);
}

TEST(Bvh, HandlesNoneOneAndAFewBoxes) {
    const Bvh none = buildBvh({}, {});
    ASSERT_EQ(none.nodes.size(), 1U);
    EXPECT_EQ(none.nodes[0].count0, 0U);
    EXPECT_EQ(none.nodes[0].count1, 0U);
    std::size_t visited = 0;
    EXPECT_EQ(nearestByWalk(none, {}, {{0, 0, -1}, {1e3F, 1e3F, 1}}, visited), Hit{});
    for (std::size_t count = 1; count < 12; ++count) expectSameHits(randomBoxes(count, 10, 1), 50);
}

TEST(Bvh, IsTheSameFromRunToRunWhenBuiltByManyThreads) {
    const Boxes boxes = randomBoxes(60'000, 100, 1);
    const Bvh first = buildBvh(boxes.mins, boxes.maxs);
    inspected(first, boxes);
    for (int repeat = 0; repeat < 3; ++repeat) {
        const Bvh again = buildBvh(boxes.mins, boxes.maxs);
        ASSERT_EQ(again.order, first.order);
        ASSERT_EQ(again.nodes.size(), first.nodes.size());
        ASSERT_EQ(std::memcmp(again.nodes.data(), first.nodes.data(), first.nodes.size() * sizeof(BvhNode)), 0);
    }
}

TEST(Bvh, RefusesBoxesThatAreNone) {
    const auto codeOf = [](const glm::vec3& min, const glm::vec3& max) {
        const std::vector<glm::vec3> mins{{0, 0, 0}, min};
        const std::vector<glm::vec3> maxs{{1, 1, 1}, max};
        try {
            buildBvh(mins, maxs);
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()).find("box 1"), std::string::npos) << error.what();
            return error.code();
        }
        return Code::kInternal;
    };
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(codeOf({nan, 0, 0}, {1, 1, 1}), Code::kInvalidArgument);
    EXPECT_EQ(codeOf({0, 0, 0}, {1, nan, 1}), Code::kInvalidArgument);
    EXPECT_EQ(codeOf({0, 0, 0}, {1, 1, kInfinity}), Code::kInvalidArgument);
    EXPECT_EQ(codeOf({0, 0, 2}, {1, 1, 1}), Code::kInvalidArgument);
    const std::vector<glm::vec3> two(2);
    EXPECT_THROW(buildBvh(two, {}), Error);
}

TEST(Bvh, HoldsBoxesAsWideAsFloatsGo) {
    const float most = std::numeric_limits<float>::max();
    Boxes boxes;
    for (int i = 0; i < 20; ++i) boxes.add(glm::vec3(-most), glm::vec3(most));
    for (int i = 0; i < 20; ++i) boxes.add(glm::vec3(static_cast<float>(i)), glm::vec3(static_cast<float>(i)));
    inspected(buildBvh(boxes.mins, boxes.maxs), boxes);
}

}  // namespace
}  // namespace radiata
