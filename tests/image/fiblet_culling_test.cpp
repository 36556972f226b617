// Which fiblets are drawn and how exactly: the coverage buffer against its twin and what it leaves out, level of detail within
// its bound.
#include <bit>
#include <cmath>
#include <iostream>

#include "image/fibre_scenes.h"
#include "image/fixture.h"
#include "reference/camera_rays.h"
#include "reference/fiblet_coverage.h"
#include "render/frame/fiblet_coverage.h"
#include "render/frame/target.h"

namespace radiata::test {
namespace {

using FibletCulling = ImageTest;

model::Camera lookingAt(const glm::dvec3& centre, bool perspective) {
    model::Camera camera;
    camera.perspective = perspective;
    camera.target_mm = centre;
    camera.eye_mm = centre + glm::dvec3(40, -30, 50);
    camera.height_mm = 28;
    camera.field_of_view_deg = 22;
    return camera;
}

double depthOfOrder(std::uint32_t order) {
    return static_cast<double>(std::bit_cast<float>((order & 0x80000000U) != 0 ? order & 0x7fffffffU : ~order));
}

/// Every texel's depth is that of balls in double, to 5 um.
TEST_F(FibletCulling, CoverageBuffersAgreeWithTheirTwin) {
    const glm::dvec3 centre(9, 4, -20);
    store.add("fibres", randomTractogram(3, 120, 300, 0.1, 8, centre));
    for (const bool perspective : {false, true}) {
        model::FrameRequest request = fibreRequest("fibres", 152, 120);
        request.camera = lookingAt(centre, perspective);
        request.quality.fiblet_culling = model::FibletCulling::kCoverage;
        render::Target target;
        const model::Frame frame = renderer.render(target, request, 0, 1, everything());
        const render::FibletCoverage& coverage = *target.impl_->fiblets[0]->coverage;
        const int columns = coverage.params().columns, rows = coverage.params().rows, edge = shader::FIBLET_TEXEL;
        ASSERT_EQ(columns, 10);
        ASSERT_EQ(rows, 8);
        std::vector<double> farthest(static_cast<std::size_t>(columns * rows), -1e300);
        for (int y = 0; y < request.height; ++y) {
            for (int x = 0; x < request.width; ++x) {
                double depth = static_cast<double>(frame.pixels.depth[static_cast<std::size_t>(y * request.width + x)]);
                if (!std::isfinite(depth)) depth = static_cast<double>(coverage.params().far_depth);
                double& texel = farthest[static_cast<std::size_t>(y / edge * columns + x / edge)];
                texel = std::max(texel, depth + frame.info.depth_offset_mm);
            }
        }
        const std::vector<double> expected =
            reference::dilatedDepths(farthest, columns, request.camera, request.width, request.height, edge, 6.3);
        std::vector<std::uint32_t> orders(farthest.size());
        gpu::download(device, coverage.dilated(), 0, std::as_writable_bytes(std::span(orders)));
        double worst = 0, carved = 0;
        for (std::size_t i = 0; i < orders.size(); ++i) {
            worst = std::max(worst, std::abs(depthOfOrder(orders[i]) + frame.info.depth_offset_mm - expected[i]));
            carved = std::max(carved, expected[i] - farthest[i]);
        }
        EXPECT_LT(worst, 5e-3) << perspective;
        EXPECT_GT(carved, 6.3);
    }
}

/// A view at rest misses next to nothing (1 % of what is shown), a jump much more, and two frames later that is over.
TEST_F(FibletCulling, CoverageMissesFibresAfterJumpsOnly) {
    store.add("fibres", randomTractogram(5, 3000, 400, 0.1, 8));
    model::FrameRequest request = fibreRequest("fibres", 160, 120);
    render::Target target;
    const model::Camera start = lookingAt(glm::dvec3(0), true);
    const auto faults = [&] {
        request.quality.fiblet_culling = model::FibletCulling::kNone;
        const model::Frame all = draw(request);
        request.quality.fiblet_culling = model::FibletCulling::kCoverage;
        const model::Frame culled = renderer.render(target, request, 0, 1, everything());
        int other = 0;
        for (std::size_t at = 0; at < all.pixels.depth.size(); ++at)
            other += all.pixels.id[4 * at + 1] != culled.pixels.id[4 * at + 1];
        std::cout << other << " of " << all.info.hit_pixels << " pixels, " << culled.info.fiblets_drawn << " of "
                  << culled.info.fiblets << " fiblets\n";
        return std::pair(other / static_cast<double>(all.info.hit_pixels),
                         static_cast<double>(culled.info.fiblets_drawn) / static_cast<double>(culled.info.fiblets));
    };
    request.camera = start;
    EXPECT_EQ(faults().first, 0) << "nothing is known yet, so nothing is hidden";
    faults();
    const auto [still, drawn] = faults();
    EXPECT_LT(still, 0.01);
    EXPECT_LT(drawn, 0.95);
    request.camera = model::orbit(start, 60, 0);
    const double jumped = faults().first;
    EXPECT_GT(jumped, still);
    faults();
    EXPECT_LT(faults().first, 0.01);
}

/// Distance of a picture point from a fibre's decoded points, as they appear.
double distancePx(const model::FrameRequest& request, std::span<const reference::FibreSegment> segments, double x, double y) {
    double nearest = 1e300;
    for (const reference::FibreSegment& segment : segments) {
        const auto place = [&](const glm::dvec3& p) {
            return glm::dvec2(reference::projectPoint(request.camera, request.width, request.height, p));
        };
        const glm::dvec2 a = place(segment.from), way = place(segment.to) - a, to = glm::dvec2(x, y) - a;
        const double length2 = glm::dot(way, way);
        const double share = length2 > 0 ? std::clamp(glm::dot(to, way) / length2, 0.0, 1.0) : 0;
        nearest = std::min(nearest, glm::length(to - share * way));
    }
    return nearest;
}

/// What is seen is the fibre of its id, and within the bound: half a pixel that lines are wide, and the bound that the frame
/// reports, which is the setting's at most. Whole fiblets become lines as well as groups of segments. Culled and unculled
/// frames are equal.
TEST_F(FibletCulling, DetailKeepsIdsWithinItsBound) {
    const model::FibletSet set = randomTractogram(6, 60, 400, 0.1, 8);
    const std::vector<reference::FibreSegment> all = decodedSegments(set);
    std::vector<std::vector<reference::FibreSegment>> by_fibre(set.fibres());
    for (const reference::FibreSegment& segment : all) {
        by_fibre[set.heads[segment.who >> shader::FIBLET_SEGMENT_BITS].fibre].push_back(segment);
    }
    store.add("fibres", set);
    for (const float detail : {0.3F, 2.0F}) {
        for (const bool perspective : {false, true}) {
            model::FrameRequest request = fibreRequest("fibres", 160, 120);
            request.camera = lookingAt(glm::dvec3(0), perspective);
            const model::Frame plain = draw(request);
            EXPECT_EQ(plain.info.fiblet_error_px, 0);
            request.quality.fiblet_detail_px = detail;
            const model::Frame frame = draw(request);
            EXPECT_GT(frame.info.fiblet_error_px, 0.1 * static_cast<double>(detail));
            EXPECT_LE(frame.info.fiblet_error_px, static_cast<double>(detail));
            double worst = 0;
            int shown = 0, changed = 0;
            for (int y = 0; y < request.height; ++y) {
                for (int x = 0; x < request.width; ++x) {
                    const auto at = static_cast<std::size_t>(y * request.width + x);
                    changed += frame.pixels.id[4 * at + 1] != plain.pixels.id[4 * at + 1];
                    if (frame.pixels.id[4 * at] < 0) continue;
                    ++shown;
                    const auto fibre = static_cast<std::size_t>(frame.pixels.id[4 * at + 1]);
                    worst = std::max(worst, distancePx(request, by_fibre[fibre], x + 0.5, y + 0.5));
                }
            }
            EXPECT_GT(shown, 2000);
            EXPECT_GT(changed, 0) << "something was simplified";
            EXPECT_LT(worst, 0.51 + frame.info.fiblet_error_px);
            request.quality.fiblet_culling = model::FibletCulling::kNone;
            const model::Frame unculled = draw(request);
            EXPECT_EQ(frame.pixels.id, unculled.pixels.id);
            EXPECT_EQ(frame.pixels.rgba, unculled.pixels.rgba);
        }
    }
    model::FrameRequest request = fibreRequest("fibres", 160, 120);
    request.quality.fiblet_detail_px = 0.01F;
    EXPECT_EQ(codeOf([&] { draw(request); }), Code::kInvalidArgument);
}

}  // namespace
}  // namespace radiata::test
