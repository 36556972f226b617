// Which fiblets are drawn and how exactly: the coverage buffer against its twin and what it leaves out, level of detail within
// its bound.
#include <array>
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

/// A segment as it appears.
struct PictureSegment {
    glm::dvec2 from, way;
};

/// Of each fibre.
std::vector<std::vector<PictureSegment>> projected(const model::FibletSet& set, const model::FrameRequest& request) {
    std::vector<std::vector<PictureSegment>> by_fibre(set.fibres());
    for (const reference::FibreSegment& segment : decodedSegments(set)) {
        const auto place = [&](const glm::dvec3& p) {
            return glm::dvec2(reference::projectPoint(request.camera, request.width, request.height, p));
        };
        const glm::dvec2 from = place(segment.from);
        by_fibre[set.heads[segment.who >> shader::FIBLET_SEGMENT_BITS].fibre].push_back({from, place(segment.to) - from});
    }
    return by_fibre;
}

/// Of a picture point from a fibre, pixels.
double distancePx(std::span<const PictureSegment> segments, const glm::dvec2& point) {
    double nearest2 = 1e300;
    for (const PictureSegment& segment : segments) {
        const glm::dvec2 to = point - segment.from;
        const double length2 = glm::dot(segment.way, segment.way);
        const double share = length2 > 0 ? std::clamp(glm::dot(to, segment.way) / length2, 0.0, 1.0) : 0;
        const glm::dvec2 off = to - share * segment.way;
        nearest2 = std::min(nearest2, glm::dot(off, off));
    }
    return std::sqrt(nearest2);
}

constexpr std::array kOfFiblets{model::FibletPipeline::kAtomic,   model::FibletPipeline::kPull,
                                model::FibletPipeline::kMesh,     model::FibletPipeline::kMeshSerial,
                                model::FibletPipeline::kGeometry, model::FibletPipeline::kTessellation};

struct DetailView {
    float detail_px;
    bool perspective;
    double height_mm;  ///< of the picture, without perspective
    bool cut;
    int shown;    ///< pixels at least
    bool of_all;  ///< pipelines; else of the compute shader alone
};
/// In those of 90 mm nearly all fiblets become one line each; in the others groups of segments do.
constexpr std::array<DetailView, 5> kDetailViews{{{0.3F, false, 28, false, 2000, true},
                                                  {0.3F, true, 28, false, 2000, false},
                                                  {2, false, 28, false, 2000, false},
                                                  {2, true, 28, false, 2000, true},
                                                  {2, false, 90, true, 200, true}}};

/// By each pipeline that draws fiblets, what is seen is the fibre of its id, and within the bound: how far the centre of a
/// line's pixel is beside it, and the bound that the frame reports, which is the setting's at most. A centre is half a pixel
/// beside a line of the compute shader, and of the device's rasteriser up to half a pixel before its end too. Culled and
/// unculled frames are equal. At most 5 % of the pixels show another fibre than by the compute shader, and 0.5 % another than
/// by `pull`.
TEST_F(FibletCulling, DetailKeepsIdsWithinItsBound) {
    const model::FibletSet set = randomTractogram(6, 60, 400, 0.1, 8);
    store.add("fibres", set);
    for (const DetailView& view : kDetailViews) {
        model::FrameRequest request = fibreRequest("fibres", 160, 120);
        request.camera = lookingAt(glm::dvec3(0), view.perspective);
        request.camera.height_mm = view.height_mm;
        if (view.cut) request.scene.layers[0].tracts().cuts = {{glm::dvec3(2, 0, 0), {1, 0.2, 0}}};
        const std::vector<std::vector<PictureSegment>> by_fibre = projected(set, request);
        std::vector<std::int32_t> by_atomics, by_pull;
        for (const model::FibletPipeline pipeline : kOfFiblets) {
            const bool atomic = pipeline == model::FibletPipeline::kAtomic;
            if (!atomic && !view.of_all) continue;
            const std::string name(model::pipelineName(pipeline));
            SCOPED_TRACE(name + ", " + std::to_string(view.detail_px) + " pixels, " + std::to_string(view.height_mm) + " mm");
            request.quality = {};
            request.quality.samples = 1;
            request.quality.fiblet_pipeline = pipeline;
            const model::Frame plain = draw(request);
            EXPECT_EQ(plain.info.fiblet_error_px, 0);
            request.quality.fiblet_detail_px = view.detail_px;
            const model::Frame frame = draw(request);
            EXPECT_GT(frame.info.fiblet_error_px, 0.1 * static_cast<double>(view.detail_px));
            EXPECT_LE(frame.info.fiblet_error_px, static_cast<double>(view.detail_px));
            if (atomic) by_atomics = frame.pixels.id;
            if (pipeline == model::FibletPipeline::kPull) by_pull = frame.pixels.id;
            double worst = 0;
            int shown = 0, changed = 0, not_atomic = 0, not_pull = 0;
            for (int y = 0; y < request.height; ++y) {
                for (int x = 0; x < request.width; ++x) {
                    const auto at = 4 * static_cast<std::size_t>(y * request.width + x);
                    const std::int32_t id = frame.pixels.id[at + 1];
                    changed += id != plain.pixels.id[at + 1];
                    not_atomic += id != by_atomics[at + 1];
                    not_pull += !by_pull.empty() && id != by_pull[at + 1];
                    if (frame.pixels.id[at] < 0) continue;
                    ++shown;
                    worst = std::max(worst, distancePx(by_fibre[static_cast<std::size_t>(id)], {x + 0.5, y + 0.5}));
                }
            }
            EXPECT_GT(shown, view.shown);
            EXPECT_GT(changed, 0) << "something was simplified";
            EXPECT_LT(worst, (atomic ? 0.51 : 0.72) + frame.info.fiblet_error_px);
            EXPECT_LE(not_atomic, 0.05 * shown);
            EXPECT_LE(not_pull, 0.005 * shown);
            request.quality.fiblet_culling = model::FibletCulling::kNone;
            const model::Frame unculled = draw(request);
            EXPECT_EQ(frame.pixels.id, unculled.pixels.id);
            EXPECT_EQ(frame.pixels.rgba, unculled.pixels.rgba);
        }
    }
}

/// The sizes that there are, and pipelines that have no fiblets.
TEST_F(FibletCulling, DetailIsRefusedWhereItMeansNothing) {
    store.add("fibres", randomTractogram(6, 5, 40, 0.1, 8));
    model::FrameRequest request = fibreRequest("fibres", 16, 12);
    request.quality.fiblet_detail_px = 0.01F;
    EXPECT_EQ(codeOf([&] { draw(request); }), Code::kInvalidArgument);
    request.quality.fiblet_detail_px = 0.3F;
    for (const model::FibletPipeline uncompressed : {model::FibletPipeline::kLines, model::FibletPipeline::kPoints}) {
        request.quality.fiblet_pipeline = uncompressed;
        EXPECT_EQ(codeOf([&] { draw(request); }), Code::kInvalidArgument) << model::pipelineName(uncompressed);
    }
}

/// Of a few pixels, fiblets are one line each by the paper's scheme, by whichever pipeline: those of the device's rasteriser
/// show the same fibres but for 0.5 % of the pixels, and differ from the compute shader's by no more than decoded ones do.
TEST_F(FibletCulling, CoverageDrawsSmallFibletsAsLines) {
    store.add("fibres", randomTractogram(9, 500, 300, 0.1, 60));
    model::FrameRequest request = fibreRequest("fibres", 64, 48);
    request.camera = lookingAt(glm::dvec3(0), false);
    request.camera.height_mm = 160;
    const auto differing = [](const model::Frame& a, const model::Frame& b) {
        int pixels = 0;
        for (std::size_t at = 1; at < a.pixels.id.size(); at += 4) pixels += a.pixels.id[at] != b.pixels.id[at];
        return pixels;
    };
    std::vector<model::Frame> decoded, small;
    for (const model::FibletPipeline pipeline : kOfFiblets) {
        request.quality.fiblet_pipeline = pipeline;
        request.quality.fiblet_culling = model::FibletCulling::kNone;
        decoded.push_back(draw(request));
        request.quality.fiblet_culling = model::FibletCulling::kCoverage;
        small.push_back(draw(request));
        const std::string_view name = model::pipelineName(pipeline);
        EXPECT_GT(differing(small.back(), decoded.back()), 100) << name;
        EXPECT_LE(differing(small.back(), small.front()), differing(decoded.back(), decoded.front())) << name;
        EXPECT_LE(differing(small.back(), small[small.size() > 1 ? 1 : 0]),
                  0.005 * static_cast<double>(small.back().info.hit_pixels))
            << name;
    }
}

}  // namespace
}  // namespace radiata::test
