// The whole server in one process, with the real renderer on whatever device there is and a small phantom in its store.
#include <cmath>
#include <cstring>
#include <future>

#include <gmock/gmock.h>

#include "build/phantom.h"
#include "encode/png.h"
#include "gpu/device.h"
#include "service/generic_call.h"
#include "service/service_fixture.h"
#include "session/vulkan_backend.h"

namespace radiata::service::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr std::uint32_t kWidth = 96, kHeight = 64;

struct Engine {
    gpu::Device device{gpu::DeviceOptions{}};
    store::Store store{device, {}};
    render::Renderer renderer{device, store};
};

class RendererTest : public ::testing::Test {
protected:
    static void SetUpTestSuite() {
        engine = std::make_unique<Engine>();
        PhantomOptions options;
        options.size = 20;
        options.lmax = 4;
        engine->store.add("phantom", phantomShImage(options));
    }
    static void TearDownTestSuite() { engine.reset(); }

    grpc::Status fit(v1::FitCameraRequest request, v1::Camera& camera) {
        grpc::ClientContext context;
        v1::FitCameraResponse response;
        const grpc::Status status = v1::CatalogService::NewStub(channel)->FitCamera(&context, request, &response);
        camera = response.camera();
        return status;
    }

    /// An axial slice of the phantom, as FitCamera shows it.
    v1::FrameRequest slice() {
        v1::FrameRequest frame;
        v1::GlyphLayer* glyphs = frame.mutable_scene()->add_layers()->mutable_glyphs();
        glyphs->set_dataset_id("phantom");
        glyphs->mutable_selection()->mutable_slice()->set_plane(v1::PLANE_AXIAL);
        v1::FitCameraRequest request;
        request.set_dataset_id("phantom");
        *request.mutable_selection() = glyphs->selection();
        request.set_aspect(static_cast<double>(kWidth) / kHeight);
        EXPECT_TRUE(fit(request, *frame.mutable_camera()).ok());
        frame.mutable_quality()->set_samples(4);
        frame.set_width(kWidth);
        frame.set_height(kHeight);
        return frame;
    }

    grpc::Status render(const v1::FrameRequest& frame, v1::Frame& answer, const std::vector<v1::Output>& outputs = {}) {
        grpc::ClientContext context;
        context.set_deadline(std::chrono::system_clock::now() + std::chrono::seconds(60));
        v1::RenderRequest request;
        *request.mutable_frame() = frame;
        for (const v1::Output output : outputs) request.add_outputs(output);
        v1::RenderResponse response;
        const grpc::Status status = v1::RenderService::NewStub(channel)->Render(&context, request, &response);
        answer = response.frame();
        return status;
    }

    static bool converged(const v1::Frame& frame) { return frame.state() == v1::FRAME_STATE_CONVERGED; }

    static std::unique_ptr<Engine> engine;
    Rig rig{session::vulkanBackend(engine->renderer, engine->store)};
    std::shared_ptr<grpc::Channel> channel = rig.channel();
};

std::unique_ptr<Engine> RendererTest::engine;

template <typename T>
std::vector<T> values(const v1::Frame& frame, v1::Output output) {
    for (const v1::OutputArray& array : frame.outputs()) {
        if (array.output() != output) continue;
        std::vector<T> result(array.data().size() / sizeof(T));
        std::memcpy(result.data(), array.data().data(), array.data().size());
        return result;
    }
    ADD_FAILURE() << "no " << v1::Output_Name(output);
    return {};
}

TEST_F(RendererTest, RenderAnswersWithAllOutputsThatAgree) {
    v1::Frame frame;
    const grpc::Status status =
        render(slice(), frame, {v1::OUTPUT_DEPTH, v1::OUTPUT_ID, v1::OUTPUT_POSITION, v1::OUTPUT_NORMAL, v1::OUTPUT_STEPS});
    ASSERT_TRUE(status.ok()) << status.error_message();
    ASSERT_EQ(frame.outputs_size(), 5);
    EXPECT_THAT(frame.outputs(2).shape(), ElementsAre(kHeight, kWidth, 3));
    const auto depth = values<float>(frame, v1::OUTPUT_DEPTH), position = values<float>(frame, v1::OUTPUT_POSITION),
               normal = values<float>(frame, v1::OUTPUT_NORMAL);
    const auto id = values<std::int32_t>(frame, v1::OUTPUT_ID), steps = values<std::int32_t>(frame, v1::OUTPUT_STEPS);
    ASSERT_EQ(depth.size(), kWidth * kHeight);
    ASSERT_EQ(steps.size(), depth.size());
    ASSERT_EQ(position.size(), 3 * depth.size());
    ASSERT_EQ(normal.size(), 3 * depth.size());
    ASSERT_EQ(id.size(), 4 * depth.size());
    const model::DatasetInfo info = engine->store.info("phantom");
    const v1::Camera& camera = frame.request().camera();
    std::uint64_t hits = 0;
    for (std::size_t i = 0; i < depth.size(); ++i) {
        const bool hit = id[4 * i] >= 0;
        EXPECT_EQ(std::isfinite(depth[i]), hit);
        EXPECT_EQ(std::isfinite(position[3 * i]), hit);
        const glm::vec3 n(normal[3 * i], normal[3 * i + 1], normal[3 * i + 2]);
        EXPECT_NEAR(glm::length(n), hit ? 1 : 0, 1e-4);
        EXPECT_GE(steps[i], 0);
        if (!hit) continue;
        ++hits;
        EXPECT_GT(steps[i], 0);
        EXPECT_EQ(id[4 * i], 0) << "the only layer";
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_GE(id[4 * i + 1 + axis], 0);
            EXPECT_LT(id[4 * i + 1 + axis], info.size[axis]);
        }
        // The line of sight is the scanner's z axis: depth, position and normal must tell the same.
        EXPECT_LE(n.z, 1e-4) << "towards the viewer, who is at the feet";
        const double z = frame.position_origin_mm(2) + position[3 * i + 2];
        EXPECT_NEAR(z - camera.eye_mm().z(), frame.depth_offset_mm() + depth[i], 1e-3);
        // The glyph stands where its voxel is, within the voxel's diagonal and what glyphs reach beyond it.
        const glm::dvec3 centre = glm::dvec3(info.voxel_to_world * glm::dvec4(id[4 * i + 1], id[4 * i + 2], id[4 * i + 3], 1));
        const glm::dvec3 point(frame.position_origin_mm(0) + position[3 * i], frame.position_origin_mm(1) + position[3 * i + 1],
                               z);
        EXPECT_LT(glm::distance(point, centre), 3 * glm::length(glm::dvec3(info.voxel_to_world[0])));
    }
    EXPECT_GT(hits, depth.size() / 20);
    EXPECT_EQ(frame.counters().capped_rays(), 0U);
    EXPECT_GT(frame.counters().glyphs(), 10U);
    EXPECT_EQ(frame.counters().glyphs_available(), info.glyph_count);
    EXPECT_EQ(frame.methods().intersection(), v1::INTERSECTION_METHOD_MARCH);
    EXPECT_NE(frame.methods().traversal(), v1::TRAVERSAL_UNSPECIFIED);
    EXPECT_FALSE(frame.methods().traversal_reason().empty());
    EXPECT_FALSE(frame.methods().pole_table_reason().empty());
    EXPECT_FALSE(frame.device().empty());
    EXPECT_GE(frame.passes_size(), 3);
    const std::string& png = frame.image();
    EXPECT_EQ(encode::decodePng({reinterpret_cast<const std::uint8_t*>(png.data()), png.size()}).width,
              static_cast<int>(kWidth));
}

TEST_F(RendererTest, FramesTellWhatTheyLeaveOut) {
    v1::FrameRequest request = slice();
    v1::Frame frame;
    ASSERT_TRUE(render(request, frame).ok());
    EXPECT_EQ(frame.left_out_size(), 0);
    request.mutable_scene()->mutable_layers(0)->mutable_glyphs()->set_lmax(2);
    ASSERT_TRUE(render(request, frame).ok());
    ASSERT_EQ(frame.left_out_size(), 1);
    EXPECT_EQ(frame.left_out(0).lmax(), 2U);
    EXPECT_EQ(frame.left_out(0).lmax_available(), 4U);
    EXPECT_THAT(frame.left_out(0).texts(), ElementsAre("bands to 2 of 4 drawn"));
}

TEST_F(RendererTest, AViewConvergesToTheBytesOfThePicture) {
    const v1::FrameRequest request = slice();
    v1::Frame picture;
    ASSERT_TRUE(render(request, picture).ok());
    v1::FrameRequest other = request;
    other.mutable_camera()->set_height_mm(0.5 * request.camera().height_mm());
    Viewer viewer(channel, other);
    ASSERT_TRUE(viewer.waitFor([](const v1::Frame&) { return true; }));
    v1::UpdateRequest change;
    change.set_camera_sequence(1);
    *change.mutable_camera() = request.camera();
    ASSERT_TRUE(viewer.update(change).ok());
    const auto last = viewer.waitFor([](const v1::Frame& f) { return f.camera_sequence() == 1 && converged(f); });
    ASSERT_TRUE(last);
    EXPECT_EQ(last->samples(), 4U);
    EXPECT_TRUE(last->image() == picture.image());
    // And so does the request that the picture says it was made from.
    v1::Frame again;
    ASSERT_TRUE(render(picture.request(), again).ok());
    EXPECT_TRUE(again.image() == picture.image());
    EXPECT_EQ(again.request().SerializeAsString(), picture.request().SerializeAsString());
}

TEST_F(RendererTest, TheTraversalAskedForIsTheOneThatRan) {
    grpc::ClientContext context;
    v1::GetLimitsResponse limits;
    ASSERT_TRUE(v1::LimitsService::NewStub(channel)->GetLimits(&context, {}, &limits).ok());
    const std::pair<const char*, v1::Traversal> all[] = {{"ray_query", v1::TRAVERSAL_RAY_QUERY},
                                                         {"bvh", v1::TRAVERSAL_BVH},
                                                         {"tiles", v1::TRAVERSAL_TILES},
                                                         {"raster_boxes", v1::TRAVERSAL_RASTER_BOXES}};
    const std::vector<std::string> there = engine->renderer.traversals();
    EXPECT_FALSE(there.empty());
    for (const auto& [name, traversal] : all) {
        v1::FrameRequest request = slice();
        request.mutable_quality()->set_traversal(traversal);
        v1::Frame frame;
        const grpc::Status status = render(request, frame);
        if (std::find(there.begin(), there.end(), name) == there.end()) {
            EXPECT_EQ(status.error_code(), grpc::StatusCode::UNIMPLEMENTED);
            EXPECT_THAT(status.error_message(), HasSubstr(name));
            continue;
        }
        ASSERT_TRUE(status.ok()) << status.error_message();
        EXPECT_EQ(frame.methods().traversal(), traversal);
        EXPECT_EQ(frame.request().quality().traversal(), traversal);
        EXPECT_EQ(frame.methods().traversal_reason(), "asked for");
        EXPECT_GT(frame.counters().hit_pixels(), 0U) << name;
    }
}

TEST_F(RendererTest, TessellatedGlyphsAreDrawnAsAskedForAndEchoed) {
    v1::FrameRequest request = slice();
    request.mutable_quality()->set_intersection(v1::INTERSECTION_METHOD_TESSELLATED);
    v1::Tessellation& wanted = *request.mutable_quality()->mutable_tessellation();
    v1::Frame frame, again;
    grpc::Status status = render(request, frame);
    ASSERT_TRUE(status.ok()) << status.error_message();
    EXPECT_EQ(frame.request().quality().intersection(), v1::INTERSECTION_METHOD_TESSELLATED);
    EXPECT_EQ(frame.request().quality().tessellation().mesh(), v1::SPHERE_MESH_ICOSPHERE);
    EXPECT_EQ(frame.request().quality().tessellation().level(), 4U);
    EXPECT_EQ(frame.request().quality().tessellation().normals(), v1::MESH_NORMALS_ANALYTIC);
    EXPECT_GT(frame.counters().hit_pixels(), 0U);
    ASSERT_TRUE(render(frame.request(), again).ok());
    EXPECT_TRUE(again.image() == frame.image());
    wanted.set_mesh(v1::SPHERE_MESH_LATITUDE_LONGITUDE);
    wanted.set_normals(v1::MESH_NORMALS_TRIANGLE);
    ASSERT_TRUE(render(request, again).ok());
    EXPECT_EQ(again.request().quality().tessellation().level(), 20U);
    EXPECT_EQ(again.request().quality().tessellation().normals(), v1::MESH_NORMALS_TRIANGLE);
    EXPECT_FALSE(again.image() == frame.image());
    wanted.set_level(200);
    status = render(request, frame);
    EXPECT_EQ(status.error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
    EXPECT_THAT(status.error_message(), HasSubstr("quality.tessellation.level is 200"));
    wanted.set_mesh(static_cast<v1::SphereMesh>(9));
    EXPECT_EQ(render(request, frame).error_code(), grpc::StatusCode::INVALID_ARGUMENT);
}

TEST_F(RendererTest, FitCameraShowsTheSelection) {
    v1::FitCameraRequest request;
    request.set_dataset_id("phantom");
    request.set_aspect(1.5);
    v1::Camera radiological, neurological, whole;
    request.mutable_selection()->mutable_slice()->set_plane(v1::PLANE_AXIAL);
    ASSERT_TRUE(fit(request, radiological).ok());
    EXPECT_LT(radiological.eye_mm().z(), radiological.target_mm().z()) << "from the feet";
    request.set_convention(v1::Annotations::CONVENTION_NEUROLOGICAL);
    ASSERT_TRUE(fit(request, neurological).ok());
    EXPECT_GT(neurological.eye_mm().z(), neurological.target_mm().z());
    request.mutable_selection()->mutable_volume();
    ASSERT_TRUE(fit(request, whole).ok());
    const model::DatasetInfo info = engine->store.info("phantom");
    EXPECT_NEAR(whole.target_mm().x(), 0.5 * (info.bounds_min.x + info.bounds_max.x), info.bounds_max.x - info.bounds_min.x);
    EXPECT_GT(whole.height_mm(), 0.5 * (info.bounds_max.y - info.bounds_min.y));
    EXPECT_LT(whole.height_mm(), 2 * (info.bounds_max.y - info.bounds_min.y));
    request.set_dataset_id("nobody");
    EXPECT_EQ(fit(request, whole).error_code(), grpc::StatusCode::NOT_FOUND);
}

TEST_F(RendererTest, BadRequestsAreRefusedWhileAnotherViewGoesOn) {
    const v1::FrameRequest good = slice();
    Viewer viewer(channel, good);
    ASSERT_TRUE(viewer.waitFor(converged));
    v1::FrameRequest unknown = good;
    unknown.mutable_scene()->mutable_layers(0)->mutable_glyphs()->set_dataset_id("../../etc/passwd");
    v1::FrameRequest lmax = good;
    lmax.mutable_scene()->mutable_layers(0)->mutable_glyphs()->set_lmax(6);
    v1::FrameRequest second = good;
    *second.mutable_scene()->add_layers() = unknown.scene().layers(0);
    v1::Frame none;
    for (std::uint64_t turn = 1; turn <= 3; ++turn) {
        EXPECT_EQ(render(unknown, none).error_code(), grpc::StatusCode::NOT_FOUND);
        EXPECT_EQ(render(second, none).error_code(), grpc::StatusCode::NOT_FOUND);
        const grpc::Status status = render(lmax, none);
        EXPECT_EQ(status.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
        EXPECT_EQ(status.error_message(), "scene.layers[0].glyphs.lmax is 6; the dataset has bands up to 4");
        Viewer bad(channel, lmax);
        EXPECT_EQ(bad.end().error_code(), grpc::StatusCode::INVALID_ARGUMENT);
        v1::UpdateRequest change;
        change.set_camera_sequence(turn);
        *change.mutable_camera() = good.camera();
        change.mutable_camera()->set_height_mm(good.camera().height_mm() / static_cast<double>(turn + 1));
        ASSERT_TRUE(viewer.update(change).ok());
        EXPECT_TRUE(viewer.waitFor([turn](const v1::Frame& f) { return f.camera_sequence() == turn && converged(f); }));
    }
}

TEST_F(RendererTest, HealthTurnsToNotServingWhenTheServerStops) {
    Viewer viewer(channel, slice());
    ASSERT_TRUE(viewer.waitFor([](const v1::Frame&) { return true; }));
    EXPECT_EQ(genericCall(channel, "/grpc.health.v1.Health/Watch", "", true).bytes, std::string("\x08\x01", 2));
    auto watch = std::async(std::launch::async, [&] { return genericCall(channel, "/grpc.health.v1.Health/Watch", ""); });
    std::this_thread::sleep_for(milliseconds(300));
    rig.server.stop();
    EXPECT_EQ(watch.get().bytes, std::string("\x08\x02", 2)) << "the last word: status NOT_SERVING";
    EXPECT_EQ(viewer.end().error_code(), grpc::StatusCode::UNAVAILABLE);
}

}  // namespace
}  // namespace radiata::service::testing
