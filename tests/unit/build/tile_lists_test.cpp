// No ray of a pixel misses a box for want of an entry in its tile's list: brute force in double over all boxes, for samples
// moved within their pixels, perspective and orthographic, boxes beside, around and behind the camera.
#include "build/tile_lists.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace radiata {
namespace {

constexpr int kWidth = 203, kHeight = 117, kShiftX = 4, kShiftY = 3;

/// Looks along -z from the reference point's height; 0.5 mm per pixel at the reference plane.
shader::CameraRays camera(double distance_mm, float near_depth, float far_depth) {
    shader::CameraRays rays{};
    // Turned by a little, so that boxes are not aligned with the picture.
    const glm::dvec3 forward = glm::normalize(glm::dvec3(0.1, -0.2, -1)), right = glm::normalize(glm::dvec3(1, 0.3, 0.04));
    const glm::dvec3 straight = glm::normalize(right - glm::dot(right, forward) * forward);
    rays.step_right = glm::vec3(0.5 * straight);
    rays.step_up = glm::vec3(0.5 * glm::cross(straight, forward));
    rays.forward = glm::vec3(forward);
    rays.inverse_distance = distance_mm > 0 ? static_cast<float>(1 / distance_mm) : 0;
    rays.near_depth = near_depth;
    rays.far_depth = far_depth;
    rays.reference_high = {1000, -200, 30};
    rays.reference_low = {1e-5F, 0, -1e-6F};
    return rays;
}

std::vector<shader::GlyphInstance> boxes(int count, float spread_mm, float size_mm, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> unit(0, 1);
    std::vector<shader::GlyphInstance> instances(count);
    for (shader::GlyphInstance& glyph : instances) {
        glyph.centre_high =
            glm::vec3(1000, -200, 30) + spread_mm * (glm::vec3(unit(random), unit(random), unit(random)) - 0.5F);
        glyph.box_min = -size_mm * glm::vec3(unit(random), unit(random), unit(random));
        glyph.box_max = size_mm * glm::vec3(unit(random), unit(random), unit(random));
    }
    return instances;
}

/// Whether the ray meets the box within the depths that are seen.
bool meets(const shader::GlyphInstance& glyph, const shader::CameraRays& rays, double x, double y) {
    const glm::dvec3 centre = glm::dvec3(glyph.centre_high) - glm::dvec3(rays.reference_high) + glm::dvec3(glyph.centre_low) -
                              glm::dvec3(rays.reference_low);
    const glm::dvec3 origin = (x - 0.5 * kWidth) * glm::dvec3(rays.step_right) + (0.5 * kHeight - y) * glm::dvec3(rays.step_up);
    // Not normalised: its parameter is the depth.
    const glm::dvec3 direction = origin * static_cast<double>(rays.inverse_distance) + glm::dvec3(rays.forward);
    double first = rays.near_depth, last = rays.far_depth;
    for (int axis = 0; axis < 3; ++axis) {
        const double a = (centre[axis] + glyph.box_min[axis] - origin[axis]) / direction[axis];
        const double b = (centre[axis] + glyph.box_max[axis] - origin[axis]) / direction[axis];
        first = std::max(first, std::min(a, b));
        last = std::min(last, std::max(a, b));
    }
    return first <= last;
}

bool listed(const TileLists& lists, int pixel_x, int pixel_y, std::uint32_t box) {
    const glm::uvec2 range =
        lists.ranges.at(static_cast<std::size_t>(pixel_y >> kShiftY) * lists.tiles_x + (pixel_x >> kShiftX));
    const auto begin = lists.entries.begin() + range.x;
    return std::binary_search(begin, begin + range.y, box);
}

/// \return  how many hits were looked up
int expectComplete(const std::vector<shader::GlyphInstance>& instances, const shader::CameraRays& rays) {
    const TileLists lists = buildTileLists(instances, rays, kWidth, kHeight, kShiftX, kShiftY, 100'000'000);
    EXPECT_TRUE(lists.complete);
    std::mt19937 random(11);
    std::uniform_real_distribution<double> jitter(-0.5, 0.5);
    int hits = 0;
    for (int ray = 0; ray < 1500; ++ray) {
        const int x = static_cast<int>(random() % kWidth), y = static_cast<int>(random() % kHeight);
        const double sample_x = x + 0.5 + jitter(random), sample_y = y + 0.5 + jitter(random);
        for (std::uint32_t i = 0; i < instances.size(); ++i) {
            if (!meets(instances[i], rays, sample_x, sample_y)) continue;
            ++hits;
            EXPECT_TRUE(listed(lists, x, y, i)) << "pixel " << x << ", " << y << ", box " << i;
        }
    }
    return hits;
}

TEST(TileLists, HoldEveryBoxThatARayMeets) {
    const auto scene = boxes(600, 100, 3, 1);
    EXPECT_GT(expectComplete(scene, camera(0, -100, 100)), 1000) << "orthographic";
    EXPECT_GT(expectComplete(scene, camera(300, -100, 100)), 1000) << "perspective";
    EXPECT_GT(expectComplete(scene, camera(1e6, -100, 100)), 1000) << "a kilometre away";
}

TEST(TileLists, HoldBoxesThatTouchTheEyesPlane) {
    // The eye stands among the boxes: some are behind it, some around it, some cross its plane.
    EXPECT_GT(expectComplete(boxes(600, 100, 3, 2), camera(20, -20, 100)), 300);
    EXPECT_GT(expectComplete(boxes(60, 100, 60, 3), camera(5, -5, 100)), 1000);
}

TEST(TileLists, LeaveOutWhatCannotBeSeen) {
    const auto countOf = [](const glm::vec3& from_reference, const shader::CameraRays& rays) {
        auto one = boxes(1, 0, 1, 4);
        one[0].centre_high = glm::vec3(1000, -200, 30) + from_reference;
        return buildTileLists(one, rays, kWidth, kHeight, kShiftX, kShiftY, 1000).entries.size();
    };
    const shader::CameraRays perspective = camera(50, -40, 60), flat = camera(0, -40, 60);
    for (const shader::CameraRays& rays : {perspective, flat}) {
        EXPECT_GE(countOf(glm::vec3(0), rays), 1U);
        EXPECT_EQ(countOf(-80.0F * rays.forward, rays), 0U) << "behind the near depth";
        EXPECT_EQ(countOf(90.0F * rays.forward, rays), 0U) << "beyond the far depth";
        EXPECT_EQ(countOf(400.0F * rays.step_right, rays), 0U) << "beside the picture";
        EXPECT_EQ(countOf(-400.0F * rays.step_up, rays), 0U) << "below it";
    }
}

TEST(TileLists, AreShortAndInOrder) {
    const auto scene = boxes(2000, 100, 0.5F, 5);
    const TileLists lists = buildTileLists(scene, camera(0, -100, 100), kWidth, kHeight, kShiftX, kShiftY, 1'000'000);
    EXPECT_EQ(lists.tiles_x, 13);
    EXPECT_EQ(lists.tiles_y, 15);
    ASSERT_EQ(lists.ranges.size(), 13U * 15);
    std::uint32_t next = 0;
    for (const glm::uvec2& range : lists.ranges) {
        EXPECT_EQ(range.x, next);
        next += range.y;
        EXPECT_TRUE(std::is_sorted(lists.entries.begin() + range.x, lists.entries.begin() + next));
    }
    EXPECT_EQ(next, lists.entries.size());
    // Boxes of about a pixel, enlarged by a pixel all round, meet one to four tiles of 16 x 8.
    EXPECT_LT(lists.entries.size(), 2U * scene.size());
}

TEST(TileLists, GiveUpBeyondTheLimit) {
    const auto scene = boxes(100, 50, 3, 6);
    const shader::CameraRays rays = camera(0, -100, 100);
    const std::size_t all = buildTileLists(scene, rays, kWidth, kHeight, kShiftX, kShiftY, 1'000'000).entries.size();
    const TileLists exact = buildTileLists(scene, rays, kWidth, kHeight, kShiftX, kShiftY, all);
    EXPECT_TRUE(exact.complete);
    EXPECT_EQ(exact.entries.size(), all);
    const TileLists over = buildTileLists(scene, rays, kWidth, kHeight, kShiftX, kShiftY, all - 1);
    EXPECT_FALSE(over.complete);
    EXPECT_TRUE(over.entries.empty());
    EXPECT_EQ(over.ranges.size(), 13U * 15);
    const TileLists none = buildTileLists({}, rays, kWidth, kHeight, kShiftX, kShiftY, 0);
    EXPECT_TRUE(none.complete);
    EXPECT_TRUE(none.entries.empty());
}

}  // namespace
}  // namespace radiata
