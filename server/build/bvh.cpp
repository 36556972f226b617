#include "build/bvh.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <string>

#include "base/error.h"
#include "base/parallel.h"

namespace radiata {
namespace {

constexpr std::size_t kBins = 16;
constexpr double kPrimitiveCost = 2;          // of testing a primitive, in units of visiting a node
constexpr std::size_t kSerialCount = 16'384;  // smaller subtrees are one task
constexpr std::size_t kCountLimit = std::size_t{1} << 31;

struct Box {
    glm::vec3 min{std::numeric_limits<float>::infinity()};
    glm::vec3 max{-std::numeric_limits<float>::infinity()};

    void add(const Box& other) {
        min = glm::min(min, other.min);
        max = glm::max(max, other.max);
    }
    /// Half the surface, in double: boxes may be 1e30 wide.
    double area() const {
        const glm::dvec3 size = glm::dvec3(max) - glm::dvec3(min);
        return size.x * size.y + size.y * size.z + size.z * size.x;
    }
};

struct Item {
    Box box;
    std::uint32_t primitive = 0;

    /// Twice the centre, which is all that sorting needs.
    double centre(int axis) const { return static_cast<double>(box.min[axis]) + static_cast<double>(box.max[axis]); }
};

struct Range {
    std::size_t begin = 0;
    std::size_t end = 0;

    std::size_t count() const { return end - begin; }
};

/// A node still to be made, in the place that is kept for it.
struct Task {
    Range range;
    std::size_t middle = 0;  ///< parts the range into its two children
    std::size_t depth = 1;   ///< nodes on the path from the root, this one included
    std::size_t node = 0;
};

/// Where centres lie, per axis.
struct Extent {
    glm::dvec3 min{std::numeric_limits<double>::infinity()};
    glm::dvec3 max{-std::numeric_limits<double>::infinity()};

    int widest() const {
        const glm::dvec3 size = max - min;
        if (size.x >= size.y && size.x >= size.z) return 0;
        return size.y >= size.z ? 1 : 2;
    }
};

struct Split {
    int axis = -1;           ///< none
    std::size_t bin = 0;     ///< first bin of the right side
    std::size_t larger = 0;  ///< primitives of the larger side
    double cost = std::numeric_limits<double>::infinity();
};

/// Levels of a subtree of this many primitives if every split halves it.
std::size_t halvingLevels(std::size_t count) { return static_cast<std::size_t>(std::bit_width(count - 1)); }

class Builder {
public:
    Builder(std::span<Item> items, std::vector<shader::BvhNode>& nodes) : items_(items), nodes_(nodes) {}

    /// Index that parts the range for a node at that depth, or the range's end where it should be one leaf.
    std::size_t part(Range range, std::size_t depth);
    /// Makes the node of a task and adds to `open` its children that are no leaves.
    void makeNode(const Task& task, std::vector<Task>& open);

private:
    Extent centreExtent(Range range) const;
    std::size_t binOf(const Item& item, const Extent& extent, int axis) const;
    Split bestSplit(Range range, const Extent& extent) const;
    std::size_t splitAtMedian(Range range, int axis);
    Box boxOf(Range range) const;

    std::span<Item> items_;
    std::vector<shader::BvhNode>& nodes_;
};

Extent Builder::centreExtent(Range range) const {
    Extent extent;
    for (std::size_t i = range.begin; i < range.end; ++i) {
        const glm::dvec3 centre(items_[i].centre(0), items_[i].centre(1), items_[i].centre(2));
        extent.min = glm::min(extent.min, centre);
        extent.max = glm::max(extent.max, centre);
    }
    return extent;
}

std::size_t Builder::binOf(const Item& item, const Extent& extent, int axis) const {
    const double place = (item.centre(axis) - extent.min[axis]) / (extent.max[axis] - extent.min[axis]);
    return std::min(static_cast<std::size_t>(place * kBins), kBins - 1);
}

Split Builder::bestSplit(Range range, const Extent& extent) const {
    struct Bin {
        Box box;
        std::size_t count = 0;
    };
    Split best;
    for (int axis = 0; axis < 3; ++axis) {
        if (!(extent.max[axis] > extent.min[axis])) continue;
        std::array<Bin, kBins> bins;
        for (std::size_t i = range.begin; i < range.end; ++i) {
            Bin& bin = bins[binOf(items_[i], extent, axis)];
            bin.box.add(items_[i].box);
            ++bin.count;
        }
        std::array<double, kBins> right_cost{};  // of bins from this one on
        Bin sum;
        for (std::size_t bin = kBins; bin-- > 1;) {
            sum.box.add(bins[bin].box);
            sum.count += bins[bin].count;
            right_cost[bin] = sum.count > 0 ? sum.box.area() * static_cast<double>(sum.count) : 0;
        }
        sum = {};
        for (std::size_t bin = 1; bin < kBins; ++bin) {
            sum.box.add(bins[bin - 1].box);
            sum.count += bins[bin - 1].count;
            if (sum.count == 0 || sum.count == range.count()) continue;
            const double cost = sum.box.area() * static_cast<double>(sum.count) + right_cost[bin];
            const std::size_t larger = std::max(sum.count, range.count() - sum.count);
            // Boxes on a line have no surface: there the more even split is the better one.
            if (cost < best.cost || (cost == best.cost && larger < best.larger)) best = {axis, bin, larger, cost};
        }
    }
    return best;
}

std::size_t Builder::splitAtMedian(Range range, int axis) {
    const std::size_t middle = range.begin + range.count() / 2;
    std::nth_element(items_.begin() + range.begin, items_.begin() + middle, items_.begin() + range.end,
                     [axis](const Item& a, const Item& b) {
                         const double centre_a = a.centre(axis);
                         const double centre_b = b.centre(axis);
                         return centre_a != centre_b ? centre_a < centre_b : a.primitive < b.primitive;
                     });
    return middle;
}

std::size_t Builder::part(Range range, std::size_t depth) {
    if (range.count() < 2) return range.end;
    const Extent extent = centreExtent(range);
    // A split that does not halve is allowed while halving from there on still ends above the greatest depth.
    const bool must_halve = depth - 1 + halvingLevels(range.count()) >= shader::BVH_DEPTH_MAX;
    const Split split = must_halve ? Split{} : bestSplit(range, extent);
    if (range.count() <= shader::BVH_LEAF_MAX) {
        const double area = boxOf(range).area();
        const double leaf_cost = kPrimitiveCost * static_cast<double>(range.count()) * area;
        if (split.axis < 0 || leaf_cost <= area + kPrimitiveCost * split.cost) return range.end;
    }
    if (split.axis < 0) return splitAtMedian(range, extent.widest());
    const auto middle = std::partition(items_.begin() + range.begin, items_.begin() + range.end,
                                       [&](const Item& item) { return binOf(item, extent, split.axis) < split.bin; });
    return static_cast<std::size_t>(middle - items_.begin());
}

Box Builder::boxOf(Range range) const {
    Box box;
    for (std::size_t i = range.begin; i < range.end; ++i) box.add(items_[i].box);
    return box;
}

void Builder::makeNode(const Task& task, std::vector<Task>& open) {
    const auto makeChild = [&](Range range, glm::vec3& min, std::uint32_t& index, glm::vec3& max, std::uint32_t& count) {
        if (range.count() == 0) return;  // an empty leaf: all zero
        const Box box = boxOf(range);
        min = box.min;
        max = box.max;
        const std::size_t middle = part(range, task.depth + 1);
        if (middle == range.end) {
            index = static_cast<std::uint32_t>(range.begin);
            count = static_cast<std::uint32_t>(range.count());
            return;
        }
        index = static_cast<std::uint32_t>(nodes_.size());
        count = shader::BVH_INNER;
        open.push_back({range, middle, task.depth + 1, nodes_.size()});
        nodes_.emplace_back();
    };
    shader::BvhNode node{};
    makeChild({task.range.begin, task.middle}, node.min0, node.index0, node.max0, node.count0);
    makeChild({task.middle, task.range.end}, node.min1, node.index1, node.max1, node.count1);
    nodes_[task.node] = node;
}

/// The nodes below and with a task's, as an array of their own whose first one is the task's.
std::vector<shader::BvhNode> makeSubtree(std::span<Item> items, Task task) {
    std::vector<shader::BvhNode> nodes(1);
    Builder builder(items, nodes);
    task.node = 0;
    std::vector<Task> open{task};
    while (!open.empty()) {
        const Task next = open.back();
        open.pop_back();
        builder.makeNode(next, open);
    }
    return nodes;
}

/// Puts a subtree's first node into the place kept for it and the others at the end.
void graft(const std::vector<shader::BvhNode>& subtree, std::size_t place, std::vector<shader::BvhNode>& nodes) {
    const auto shift = static_cast<std::uint32_t>(nodes.size() - 1);
    for (std::size_t i = 0; i < subtree.size(); ++i) {
        shader::BvhNode node = subtree[i];
        if (node.count0 == shader::BVH_INNER) node.index0 += shift;
        if (node.count1 == shader::BVH_INNER) node.index1 += shift;
        if (i == 0) {
            nodes[place] = node;
        } else {
            nodes.push_back(node);
        }
    }
}

std::vector<Item> checkedItems(std::span<const glm::vec3> mins, std::span<const glm::vec3> maxs) {
    if (mins.size() != maxs.size()) {
        throw Error(Code::kInvalidArgument, "a hierarchy was given " + std::to_string(mins.size()) + " lower and " +
                                                std::to_string(maxs.size()) + " upper corners; each box needs both");
    }
    if (mins.size() >= kCountLimit) {
        throw Error(Code::kResourceExhausted, "a hierarchy holds less than 2^31 boxes, not " + std::to_string(mins.size()));
    }
    std::vector<Item> items(mins.size());
    for (std::size_t i = 0; i < items.size(); ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            const float low = mins[i][axis];
            const float high = maxs[i][axis];
            if (std::isfinite(low) && std::isfinite(high) && low <= high) continue;
            throw Error(Code::kInvalidArgument, "box " + std::to_string(i) + " reaches from " + std::to_string(low) + " to " +
                                                    std::to_string(high) + " on axis " + std::to_string(axis) +
                                                    "; finite ascending numbers are needed");
        }
        items[i] = {{mins[i], maxs[i]}, static_cast<std::uint32_t>(i)};
    }
    return items;
}

}  // namespace

Bvh buildBvh(std::span<const glm::vec3> mins, std::span<const glm::vec3> maxs) {
    std::vector<Item> items = checkedItems(mins, maxs);
    Bvh bvh;
    bvh.nodes.resize(1);
    const Range all{0, items.size()};
    Builder builder(items, bvh.nodes);
    std::vector<Task> open{{all, builder.part(all, 1)}};
    std::vector<Task> small;
    while (!open.empty()) {
        const Task task = open.back();
        open.pop_back();
        if (task.range.count() > kSerialCount) {
            builder.makeNode(task, open);
        } else {
            small.push_back(task);
        }
    }
    // Tasks share no items, and are cut by size alone, so the result does not depend on the number of threads.
    std::vector<std::vector<shader::BvhNode>> subtrees(small.size());
    parallelFor(small.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) subtrees[i] = makeSubtree(items, small[i]);
    });
    for (std::size_t i = 0; i < small.size(); ++i) graft(subtrees[i], small[i].node, bvh.nodes);

    Box box;
    bvh.order.reserve(items.size());
    for (const Item& item : items) {
        bvh.order.push_back(item.primitive);
        box.add(item.box);
    }
    if (!items.empty()) {
        bvh.min = box.min;
        bvh.max = box.max;
    }
    return bvh;
}

}  // namespace radiata
