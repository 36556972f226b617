// Which voxels a slice, slab or volume takes, for images that lie in the scanner in every way: flipped, permuted, oblique,
// sheared.
#include "build/glyph_instances.h"

#include <cmath>
#include <random>
#include <set>

#include <gmock/gmock.h>
#include <glm/gtc/matrix_transform.hpp>

namespace radiata {
namespace {

using model::Plane;
using model::Region;

model::ShImage imageOf(const glm::ivec3& size, const glm::dmat4& voxel_to_world) {
    model::ShImage image;
    image.size = size;
    image.voxel_to_world = voxel_to_world;
    for (int k = 0; k < size.z; ++k) {
        for (int j = 0; j < size.y; ++j) {
            for (int i = 0; i < size.x; ++i) image.voxels.push_back({i, j, k});
        }
    }
    image.coefficients.assign(image.voxels.size(), 1.0F);
    return image;
}

/// Columns are the voxel edges.
glm::dmat4 affine(const glm::dvec3& i, const glm::dvec3& j, const glm::dvec3& k, const glm::dvec3& first = {10, 20, 30}) {
    return {glm::dvec4(i, 0), glm::dvec4(j, 0), glm::dvec4(k, 0), glm::dvec4(first, 1)};
}

glm::dmat4 tilted() {
    const glm::dmat4 turn = glm::rotate(glm::dmat4(1), 0.3, glm::normalize(glm::dvec3(1, 2, 0.5)));
    return turn * affine({2, 0, 0}, {0, 2.5, 0}, {0, 0, 3});
}

glm::dvec3 worldOf(const model::ShImage& image, const glm::dvec3& voxel) {
    return glm::dvec3(image.voxel_to_world * glm::dvec4(voxel, 1));
}

model::VoxelSelection select(Region region, Plane plane, std::optional<glm::dvec3> position = {}) {
    model::VoxelSelection selection;
    selection.region = region;
    selection.plane = plane;
    selection.position_mm = position;
    return selection;
}

/// The voxel indices along the three axes that the selection takes.
std::array<std::set<int>, 3> taken(const model::ShImage& image, const model::VoxelSelection& selection) {
    std::array<std::set<int>, 3> result;
    for (const std::uint32_t slot : selectVoxels(image, selection)) {
        for (std::size_t axis = 0; axis < 3; ++axis) result[axis].insert(image.voxels[slot][static_cast<int>(axis)]);
    }
    return result;
}

/// The slice through a voxel's centre, and off it by less than half a voxel, is that voxel's layer and all of it.
void expectLayer(const glm::dmat4& matrix, Plane plane, std::size_t axis) {
    const model::ShImage image = imageOf({5, 6, 7}, matrix);
    const glm::ivec3 chosen(1, 4, 2);
    for (const double off : {0.0, 0.49, -0.49}) {
        glm::dvec3 voxel(chosen);
        voxel[static_cast<int>(axis)] += off;
        const auto layers = taken(image, select(Region::kSlice, plane, worldOf(image, voxel)));
        for (std::size_t other = 0; other < 3; ++other) {
            const std::size_t expected = other == axis ? 1 : static_cast<std::size_t>(image.size[static_cast<int>(other)]);
            EXPECT_EQ(layers[other].size(), expected) << "axis " << other << ", off " << off;
        }
        EXPECT_EQ(*layers[axis].begin(), chosen[static_cast<int>(axis)]) << off;
    }
}

TEST(SelectVoxels, SlicesFollowTheNearestVoxelAxis) {
    const glm::dmat4 identity(1);
    const glm::dmat4 flipped = affine({-2, 0, 0}, {0, -2, 0}, {0, 0, -2});
    const glm::dmat4 permuted = affine({0, 0, 2}, {-3, 0, 0}, {0, 2, 0});  // i up, j to the left, k to the front
    struct Case {
        glm::dmat4 matrix;
        std::size_t sagittal, coronal, axial;
    };
    const Case cases[] = {{identity, 0, 1, 2}, {flipped, 0, 1, 2}, {permuted, 1, 2, 0}, {tilted(), 0, 1, 2}};
    for (const Case& c : cases) {
        expectLayer(c.matrix, Plane::kSagittal, c.sagittal);
        expectLayer(c.matrix, Plane::kCoronal, c.coronal);
        expectLayer(c.matrix, Plane::kAxial, c.axial);
    }
}

TEST(SelectVoxels, ThreePlanesFollowThreeDifferentAxesEvenAtFortyFiveDegrees) {
    const glm::dmat4 turn = glm::rotate(glm::dmat4(1), std::acos(0.0) / 2, glm::dvec3(1, 0, 0));
    const model::ShImage image = imageOf({3, 4, 5}, turn * affine({1, 0, 0}, {0, 1, 0}, {0, 0, 1}));
    std::set<std::size_t> axes;
    for (const Plane plane : {Plane::kSagittal, Plane::kCoronal, Plane::kAxial}) {
        const auto layers = taken(image, select(Region::kSlice, plane));
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (layers[axis].size() == 1) axes.insert(axis);
        }
    }
    EXPECT_EQ(axes.size(), 3U);
}

TEST(SelectVoxels, PositionsOutsideTakeNothingAndNoneTakesTheMiddle) {
    const model::ShImage image = imageOf({5, 6, 7}, tilted());
    EXPECT_TRUE(selectVoxels(image, select(Region::kSlice, Plane::kAxial, worldOf(image, {2, 2, 7.6}))).empty());
    EXPECT_TRUE(selectVoxels(image, select(Region::kSlice, Plane::kAxial, glm::dvec3(0, 0, 1e300))).empty());
    EXPECT_EQ(*taken(image, select(Region::kSlice, Plane::kAxial))[2].begin(), 3);
    // The middle of an even number of layers lies between two: the upper one is taken.
    EXPECT_EQ(*taken(imageOf({4, 4, 4}, glm::dmat4(1)), select(Region::kSlice, Plane::kAxial))[2].begin(), 2);
}

TEST(SelectVoxels, AnObliqueSliceCoversItsPlaneWithoutGaps) {
    const model::ShImage image = imageOf({12, 13, 14}, tilted());
    std::mt19937 random(5);
    std::normal_distribution<double> gauss;
    std::uniform_real_distribution<double> unit(0, 1);
    for (int plane = 0; plane < 8; ++plane) {
        model::VoxelSelection selection = select(Region::kSlice, Plane::kOblique, worldOf(image, {5.3, 6.1, 7.2}));
        selection.normal = 3.0 * glm::dvec3(gauss(random), gauss(random), gauss(random));
        std::set<std::array<int, 3>> cells;
        const std::vector<std::uint32_t> slots = selectVoxels(image, selection);
        for (const std::uint32_t slot : slots) {
            const glm::ivec3 voxel = image.voxels[slot];
            cells.insert({voxel.x, voxel.y, voxel.z});
        }
        const glm::dvec3 normal = glm::normalize(selection.normal);
        for (int i = 0; i < 2000; ++i) {
            // A random place in the grid, moved onto the plane: the cell it then lies in must be there.
            const glm::dvec3 place =
                worldOf(image, glm::dvec3(unit(random), unit(random), unit(random)) * glm::dvec3(image.size));
            const glm::dvec3 on_plane = place - glm::dot(place - *selection.position_mm, normal) * normal;
            const glm::dvec3 voxel = glm::dvec3(glm::inverse(image.voxel_to_world) * glm::dvec4(on_plane, 1));
            const glm::ivec3 cell(glm::floor(voxel + 0.5));
            if (glm::any(glm::lessThan(cell, glm::ivec3(0))) || glm::any(glm::greaterThanEqual(cell, image.size))) continue;
            EXPECT_TRUE(cells.contains({cell.x, cell.y, cell.z})) << plane << ": " << cell.x << ' ' << cell.y << ' ' << cell.z;
        }
        // And no cell that the plane leaves alone: some corner on either side, to rounding.
        for (const std::uint32_t slot : slots) {
            double lowest = 1e300, highest = -1e300;
            for (int corner = 0; corner < 8; ++corner) {
                const glm::dvec3 half((corner & 1) ? 0.5 : -0.5, (corner & 2) ? 0.5 : -0.5, (corner & 4) ? 0.5 : -0.5);
                const double side =
                    glm::dot(normal, worldOf(image, glm::dvec3(image.voxels[slot]) + half) - *selection.position_mm);
                lowest = std::min(lowest, side);
                highest = std::max(highest, side);
            }
            EXPECT_TRUE(lowest <= 1e-6 && highest >= -1e-6) << lowest << ' ' << highest;
        }
    }
}

TEST(SelectVoxels, ASlabTakesCentresWithinHalfItsThickness) {
    const model::ShImage image = imageOf({5, 6, 9}, affine({2, 0, 0}, {0, 2, 0}, {0, 0, -3}));
    model::VoxelSelection slab = select(Region::kSlab, Plane::kAxial, worldOf(image, {0, 0, 4}));
    const std::pair<double, std::set<int>> cases[] = {{1, {4}}, {5.9, {4}}, {6, {3, 4, 5}}, {12.1, {2, 3, 4, 5, 6}}};
    for (const auto& [thickness, layers] : cases) {
        slab.thickness_mm = thickness;
        EXPECT_EQ(taken(image, slab)[2], layers) << thickness;
        EXPECT_EQ(taken(image, slab)[0].size(), 5U);
    }
    slab.thickness_mm = 1e6;
    EXPECT_EQ(selectVoxels(image, slab).size(), image.voxels.size());
}

TEST(SelectVoxels, AVolumeTakesAllInOrderAndAnEmptyDatasetNothing) {
    const model::ShImage image = imageOf({2, 3, 4}, tilted());
    const std::vector<std::uint32_t> slots = selectVoxels(image, {});
    ASSERT_EQ(slots.size(), 24U);
    for (std::uint32_t i = 0; i < 24; ++i) EXPECT_EQ(slots[i], i);
    model::ShImage empty = image;
    empty.voxels.clear();
    empty.coefficients.clear();
    for (const Region region : {Region::kVolume, Region::kSlice, Region::kSlab}) {
        for (const Plane plane : {Plane::kAxial, Plane::kCoronal, Plane::kSagittal, Plane::kOblique}) {
            EXPECT_TRUE(selectVoxels(empty, select(region, plane)).empty());
        }
    }
    glm::dvec3 low, high;
    datasetBounds(empty, low, high);
    glm::dvec3 grid_low, grid_high;
    datasetBounds(image, grid_low, grid_high);
    EXPECT_EQ(low, grid_low) << "of the grid, where there is no glyph";
    EXPECT_EQ(high, grid_high);
}

TEST(DatasetGeometry, BoundsCentreAndHalfVoxel) {
    model::ShImage image = imageOf({4, 5, 6}, affine({-2, 0, 0}, {0, 2.5, 0}, {0, 0, 3}));
    glm::dvec3 low, high;
    datasetBounds(image, low, high);
    EXPECT_EQ(low, glm::dvec3(10 - 7, 20 - 1.25, 30 - 1.5));
    EXPECT_EQ(high, glm::dvec3(10 + 1, 20 + 11.25, 30 + 16.5));
    EXPECT_EQ(datasetCentre(image), 0.5 * (low + high));
    EXPECT_EQ(halfVoxel(image), 1);
    image.voxels = {{1, 2, 3}};
    datasetBounds(image, low, high);
    EXPECT_EQ(low, glm::dvec3(7, 23.75, 37.5)) << "of the stored voxels only";
    EXPECT_EQ(high, glm::dvec3(9, 26.25, 40.5));
    EXPECT_NEAR(halfVoxel(imageOf({1, 1, 1}, tilted())), 1, 1e-12);
}

TEST(SliceNormal, IsOrthogonalToTheLayerAndPointsToTheAnatomicalSide) {
    // Sheared: the third edge leans, the layers of constant k stay axial.
    const model::ShImage sheared = imageOf({3, 3, 3}, affine({-2, 0, 0}, {0, 2, 0}, {0.5, 0.5, -2}));
    EXPECT_NEAR(glm::distance(sliceNormal(sheared, select(Region::kSlice, Plane::kAxial)), glm::dvec3(0, 0, 1)), 0, 1e-12);
    for (const glm::dmat4& matrix : {tilted(), affine({0, 0, 2}, {-3, 0, 0}, {0, 2, 0})}) {
        const model::ShImage image = imageOf({3, 3, 3}, matrix);
        const Plane planes[] = {Plane::kSagittal, Plane::kCoronal, Plane::kAxial};
        for (int axis = 0; axis < 3; ++axis) {
            const glm::dvec3 normal = sliceNormal(image, select(Region::kSlice, planes[axis]));
            EXPECT_NEAR(glm::length(normal), 1, 1e-12);
            EXPECT_GT(normal[axis], 0.7);
        }
    }
    model::VoxelSelection oblique = select(Region::kSlice, Plane::kOblique);
    oblique.normal = {0, -5, 0};
    EXPECT_EQ(sliceNormal(sheared, oblique), glm::dvec3(0, -1, 0));
}

}  // namespace
}  // namespace radiata
