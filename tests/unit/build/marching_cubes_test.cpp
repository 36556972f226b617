#include "build/marching_cubes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "base/error.h"
#include "build/folded_ball.h"

namespace radiata {
namespace {

TEST(MarchingCubes, EveryCaseHasEachCrossedEdgeInOneLoop) {
    for (unsigned inside = 0; inside < 256; ++inside) {
        std::set<int> crossed, met;
        for (int axis = 0; axis < 3; ++axis) {
            for (unsigned n = 0; n < 4; ++n) {
                const unsigned low = (n & 1U) << ((axis + 1) % 3) | (n >> 1U) << ((axis + 2) % 3), high = low | 1U << axis;
                if ((inside >> low & 1U) != (inside >> high & 1U)) crossed.insert(4 * axis + static_cast<int>(n));
            }
        }
        for (const std::vector<int>& loop : cubeLoops(inside)) {
            EXPECT_GE(loop.size(), 3U);
            for (const int edge : loop) EXPECT_TRUE(met.insert(edge).second) << inside;
        }
        EXPECT_EQ(met, crossed) << inside;
    }
}

TEST(MarchingCubes, SurfacesAreClosedAndTurnedOutwards) {
    const model::ScalarImage image = foldedBall(40);
    const SurfaceMesh mesh = marchCubes(image, 30);
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
    double volume = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
        const std::uint32_t a = mesh.triangles[t], b = mesh.triangles[t + 1], c = mesh.triangles[t + 2];
        for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
            ++sides[{std::min(from, to), std::max(from, to)}];
            EXPECT_NE(from, to);
        }
        volume +=
            glm::dot(glm::dvec3(mesh.positions[a]), glm::cross(glm::dvec3(mesh.positions[b]), glm::dvec3(mesh.positions[c]))) /
            6;
    }
    for (const auto& [side, count] : sides) ASSERT_EQ(count % 2, 0) << side.first << " " << side.second;
    EXPECT_GT(mesh.triangles.size(), 10'000U);
    EXPECT_GT(volume, 1000);  // of what is inside: triangles turn outwards
}

TEST(MarchingCubes, ABallHasItsAreaAndNormals) {
    model::ScalarImage ball;
    ball.size = glm::ivec3(48);
    for (int n = 0; n < 48 * 48 * 48; ++n) {
        ball.values.push_back(18.3F - glm::length(glm::vec3(n % 48, n / 48 % 48, n / (48 * 48)) - 23.5F));
    }
    const SurfaceMesh mesh = marchCubes(ball, 0);
    double area = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
        const glm::dvec3 a(mesh.positions[mesh.triangles[t]]), b(mesh.positions[mesh.triangles[t + 1]]),
            c(mesh.positions[mesh.triangles[t + 2]]);
        area += 0.5 * glm::length(glm::cross(b - a, c - a));
    }
    EXPECT_NEAR(area / (4 * std::numbers::pi * 18.3 * 18.3), 1, 0.01);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::vec3 out = mesh.positions[i] - 23.5F;
        ASSERT_NEAR(glm::length(out), 18.3, 0.02);
        ASSERT_GT(glm::dot(mesh.normals[i], glm::normalize(out)), 0.999F);
    }
}

TEST(MarchingCubes, LeavesOutCellsWithoutNumbersAndOneSlice) {
    model::ScalarImage ramp;
    ramp.size = {4, 4, 4};
    for (int n = 0; n < 64; ++n) ramp.values.push_back(static_cast<float>(n % 4));
    EXPECT_EQ(marchCubes(ramp, 1.5F).triangles.size(), 3U * 2 * 9);
    ramp.values[1] = std::nanf("");
    EXPECT_EQ(marchCubes(ramp, 1.5F).triangles.size(), 3U * 2 * 8);
    ramp.size.z = 1;
    EXPECT_THROW(marchCubes(ramp, 1.5F), Error);
}

}  // namespace
}  // namespace radiata
