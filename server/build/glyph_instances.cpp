#include "build/glyph_instances.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace radiata {
namespace {

glm::dvec3 worldOf(const model::ShImage& image, const glm::dvec3& voxel) {
    return glm::dvec3(image.voxel_to_world * glm::dvec4(voxel, 1.0));
}

/// The voxel axis whose world direction is nearest to an anatomical axis, and no other axis' choice.
int nearestVoxelAxis(const model::ShImage& image, int world_axis) {
    // Of all six assignments of voxel axes to world axes the one with the largest sum of |cosines|.
    constexpr int kOrders[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
    double best = -1;
    int chosen = world_axis;
    for (const auto& order : kOrders) {
        double sum = 0;
        for (int w = 0; w < 3; ++w) sum += std::abs(glm::normalize(glm::dvec3(image.voxel_to_world[order[w]]))[w]);
        if (sum > best + 1e-12) {
            best = sum;
            chosen = order[world_axis];
        }
    }
    return chosen;
}

int worldAxis(model::Plane plane) {
    switch (plane) {
        case model::Plane::kSagittal:
            return 0;
        case model::Plane::kCoronal:
            return 1;
        default:
            return 2;
    }
}

}  // namespace

void datasetBounds(const model::ShImage& image, glm::dvec3& minimum, glm::dvec3& maximum) {
    glm::ivec3 low(std::numeric_limits<int>::max()), high(std::numeric_limits<int>::min());
    for (const glm::ivec3& voxel : image.voxels) {
        low = glm::min(low, voxel);
        high = glm::max(high, voxel);
    }
    if (image.voxels.empty()) {
        low = glm::ivec3(0);
        high = image.size - 1;
    }
    minimum = glm::dvec3(std::numeric_limits<double>::infinity());
    maximum = -minimum;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 voxel((corner & 1) ? high.x + 0.5 : low.x - 0.5, (corner & 2) ? high.y + 0.5 : low.y - 0.5,
                               (corner & 4) ? high.z + 0.5 : low.z - 0.5);
        const glm::dvec3 world = worldOf(image, voxel);
        minimum = glm::min(minimum, world);
        maximum = glm::max(maximum, world);
    }
}

glm::dvec3 datasetCentre(const model::ShImage& image) {
    glm::dvec3 minimum, maximum;
    datasetBounds(image, minimum, maximum);
    return 0.5 * (minimum + maximum);
}

double halfVoxel(const model::ShImage& image) {
    double shortest = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) shortest = std::min(shortest, glm::length(glm::dvec3(image.voxel_to_world[axis])));
    return 0.5 * shortest;
}

glm::dvec3 sliceNormal(const model::ShImage& image, const model::VoxelSelection& selection) {
    if (selection.plane == model::Plane::kOblique) return glm::normalize(selection.normal);
    const int axis = nearestVoxelAxis(image, worldAxis(selection.plane));
    // The normal of the layer, which differs from the third edge's direction where the affine shears.
    const glm::dvec3 a = glm::dvec3(image.voxel_to_world[(axis + 1) % 3]), b = glm::dvec3(image.voxel_to_world[(axis + 2) % 3]);
    const glm::dvec3 normal = glm::normalize(glm::cross(a, b));
    return normal[worldAxis(selection.plane)] < 0 ? -normal : normal;
}

std::vector<std::uint32_t> selectVoxels(const model::ShImage& image, const model::VoxelSelection& selection) {
    std::vector<std::uint32_t> slots;
    const auto count = static_cast<std::uint32_t>(image.voxels.size());
    if (selection.region == model::Region::kVolume) {
        slots.resize(count);
        for (std::uint32_t i = 0; i < count; ++i) slots[i] = i;
        return slots;
    }
    const glm::dvec3 position = selection.position_mm.value_or(datasetCentre(image));
    if (selection.region == model::Region::kSlice && selection.plane != model::Plane::kOblique) {
        const int axis = nearestVoxelAxis(image, worldAxis(selection.plane));
        const glm::dvec3 voxel = glm::dvec3(glm::inverse(image.voxel_to_world) * glm::dvec4(position, 1.0));
        // Half-way positions, such as the middle of an even number of layers, take the upper layer.
        const double layer = std::floor(voxel[axis] + 0.5 + 1e-6);
        for (std::uint32_t i = 0; i < count; ++i) {
            if (image.voxels[i][axis] == layer) slots.push_back(i);
        }
        return slots;
    }
    const glm::dvec3 normal = sliceNormal(image, selection);
    double reach = 0.5 * selection.thickness_mm;
    if (selection.region == model::Region::kSlice) {
        reach = 0;
        for (int axis = 0; axis < 3; ++axis) reach += 0.5 * std::abs(glm::dot(normal, glm::dvec3(image.voxel_to_world[axis])));
    }
    reach *= 1 + 1e-9;
    for (std::uint32_t i = 0; i < count; ++i) {
        if (std::abs(glm::dot(normal, worldOf(image, glm::dvec3(image.voxels[i])) - position)) <= reach) slots.push_back(i);
    }
    return slots;
}

}  // namespace radiata
