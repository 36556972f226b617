// Every way to draw fibres shows the same ones as the compute shader, up to how lines are put on pixels.
#include <array>
#include <cstdlib>
#include <string>

#include "image/fibre_scenes.h"
#include "image/fixture.h"

namespace radiata::test {
namespace {

using Pipeline = model::FibletPipeline;
constexpr std::array kByRasteriser{Pipeline::kPull,     Pipeline::kMesh,         Pipeline::kMeshSerial,
                                   Pipeline::kGeometry, Pipeline::kTessellation, Pipeline::kLines};

struct Differences {
    int shown = 0;     ///< pixels of either picture
    int fibre = 0;     ///< that show another fibre, or only one of the two something
    int point = 0;     ///< of the same fibre, but more than one point off
    double depth = 0;  ///< largest, mm, where the segment is the same
};

Differences differences(const model::FramePixels& a, const model::FramePixels& b) {
    Differences found;
    for (std::size_t at = 0; at < a.depth.size(); ++at) {
        const std::int32_t *one = &a.id[4 * at], *other = &b.id[4 * at];
        if (one[0] < 0 && other[0] < 0) continue;
        ++found.shown;
        if (one[0] != other[0] || one[1] != other[1]) {
            ++found.fibre;
        } else if (std::abs(one[2] - other[2]) > 1) {
            ++found.point;
        } else if (one[2] == other[2]) {
            found.depth = std::max(found.depth, std::abs(double{a.depth[at]} - double{b.depth[at]}));
        }
    }
    return found;
}

class FibrePipelines : public ImageTest {};

/// Lines of the device's rasteriser: at most 4 % of the pixels that show something show another fibre than the compute shader
/// finds, 2.5 % another point of it, two or more away; among each other, 0.5 % of both. Depths of equal segments agree to 20
/// um.
TEST_F(FibrePipelines, ShowTheSameFibres) {
    const glm::dvec3 centre(13, -40, 22);
    store.add("fibres", randomTractogram(7, 40, 200, 0.4, 15, centre));
    model::FrameRequest request = fibreRequest("fibres", 160, 120);
    request.camera.target_mm = centre;
    request.camera.eye_mm = centre + glm::dvec3(60, -50, 70);
    for (int view = 0; view < 6; ++view) {
        request.camera.perspective = view % 2 == 1;
        request.camera.height_mm = view < 4 ? 50 : 6;
        request.camera.field_of_view_deg = view < 4 ? 30 : 4;
        model::TractogramLayer& layer = request.scene.layers[0].tracts();
        layer.line_width_px = view == 2 ? 3 : 1;
        layer.cuts.clear();
        if (view == 3) layer.cuts = {{centre, {1, 0.3, 0}}, {centre + glm::dvec3(0, 0, 3), {0, 0, 1}}};
        request.quality.fiblet_pipeline = Pipeline::kAtomic;
        const model::Frame atomic = draw(request);
        request.quality.fiblet_pipeline = Pipeline::kPull;
        const model::Frame pull = draw(request);
        for (const Pipeline pipeline : kByRasteriser) {
            request.quality.fiblet_pipeline = pipeline;
            const model::Frame frame = draw(request);
            EXPECT_EQ(frame.info.request.quality.fiblet_pipeline, pipeline);
            const std::string what = std::string(model::pipelineName(pipeline)) + ", view " + std::to_string(view);
            const Differences from_atomic = differences(frame.pixels, atomic.pixels);
            EXPECT_GT(from_atomic.shown, 300) << what;
            EXPECT_LE(from_atomic.fibre, 0.04 * from_atomic.shown) << what;
            EXPECT_LE(from_atomic.point, 0.025 * from_atomic.shown) << what;
            EXPECT_LT(from_atomic.depth, 0.02) << what;
            const Differences from_pull = differences(frame.pixels, pull.pixels);
            EXPECT_LE(from_pull.fibre + from_pull.point, 0.005 * from_pull.shown) << what;
        }
        if (view >= 2) continue;
        // Points are a pixel apart here: they miss some pixels, and have some that lines pass beside of their centres.
        request.quality.fiblet_pipeline = Pipeline::kPoints;
        const Differences from_atomic = differences(draw(request).pixels, atomic.pixels);
        EXPECT_LE(from_atomic.fibre, 0.25 * from_atomic.shown);
        EXPECT_LE(from_atomic.point, 0.025 * from_atomic.shown);
    }
}

/// Culled and unculled frames of a pipeline have the same ids and depths, whatever was seen before.
TEST_F(FibrePipelines, DoNotDependOnCulling) {
    const glm::dvec3 centre(-3, 8, 1);
    store.add("fibres", randomTractogram(8, 100, 300, 0.3, 8, centre));
    for (const Pipeline pipeline : {Pipeline::kPull, Pipeline::kMesh, Pipeline::kGeometry, Pipeline::kTessellation}) {
        std::mt19937 random(9);
        render::Target kept;
        int shown = 0;
        for (int i = 0; i < 25; ++i) {
            model::FrameRequest request = fibreRequest("fibres", 32, 24);
            request.quality.fiblet_pipeline = pipeline;
            request.camera = randomCamera(random, centre, 15);
            // Selected fibres are tubes, by the compute shader; the others are lines.
            if (i % 4 == 3) {
                request.scene.layers[0].tracts().tube_radius_mm = 0.2F;
                request.scene.layers[0].tracts().selected.emplace().fibres = {1, 5, 9, 33};
            }
            request.quality.fiblet_culling = model::FibletCulling::kNone;
            const model::Frame all = draw(request);
            request.quality.fiblet_culling = model::FibletCulling::kTwoPhase;
            const model::Frame culled = renderer.render(kept, request, 0, 1, everything());
            ASSERT_EQ(all.pixels.id, culled.pixels.id) << model::pipelineName(pipeline) << ", camera " << i;
            ASSERT_EQ(all.pixels.depth, culled.pixels.depth) << model::pipelineName(pipeline) << ", camera " << i;
            EXPECT_LE(culled.info.fiblets_drawn, culled.info.fiblets);
            shown += all.info.hit_pixels > 60;
        }
        EXPECT_GT(shown, 8) << "cameras that see something";
    }
}

/// The known lattice, by each; what was tested is not tested again.
TEST_F(FibrePipelines, PassTheirSelfTest) {
    const std::vector<std::string> all{"atomic", "pull", "mesh", "mesh-serial", "geometry", "tessellation", "lines", "points"};
    EXPECT_EQ(renderer.testFibrePipelines(), all);
    const std::size_t made = renderer.pipelineCount();
    EXPECT_EQ(renderer.testFibrePipelines(), all);
    EXPECT_EQ(renderer.pipelineCount(), made);
}

/// Picks answer with what the picture shows, by its own pipeline.
TEST_F(FibrePipelines, ArePickedWhereTheyAreSeen) {
    store.add("fibres", randomTractogram(12, 30, 150, 0.4, 12));
    model::FrameRequest request = fibreRequest("fibres", 48, 36);
    request.camera.eye_mm = {30, 20, 40};
    request.camera.height_mm = 30;
    for (const Pipeline pipeline : {Pipeline::kMesh, Pipeline::kPull, Pipeline::kPoints}) {
        request.quality.fiblet_pipeline = pipeline;
        const model::Frame frame = draw(request);
        int picked = 0;
        for (int at = 0; at < 48 * 36; at += 17) {
            const std::int32_t* id = &frame.pixels.id[4 * static_cast<std::size_t>(at)];
            const auto answer = renderer.pick(request, at % 48, at / 48);
            ASSERT_EQ(answer.has_value(), id[0] >= 0) << model::pipelineName(pipeline) << " " << at;
            if (!answer) continue;
            ++picked;
            EXPECT_EQ(static_cast<std::int32_t>(std::get<model::PickedFibre>(*answer).fibre), id[1]);
        }
        EXPECT_GT(picked, 10);
    }
}

}  // namespace
}  // namespace radiata::test
