// Bad requests get a status and one sentence with the field and the value; the server and other views live on.
#include <cmath>
#include <limits>
#include <random>

#include <gmock/gmock.h>

#include "service/generic_call.h"
#include "service/service_fixture.h"

namespace radiata::service::testing {
namespace {

using ::testing::HasSubstr;

struct Case {
    const char* name;
    std::function<void(v1::FrameRequest&)> spoil;
    grpc::StatusCode code;
    const char* sentence;  ///< must be part of it
};

v1::GlyphLayer* glyphs(v1::FrameRequest& frame) { return frame.mutable_scene()->mutable_layers(0)->mutable_glyphs(); }

v1::Uncertainty* uncertainty(v1::FrameRequest& frame) {
    v1::Uncertainty* message = glyphs(frame)->mutable_uncertainty();
    message->set_dataset_id("any");
    return message;
}

std::vector<Case> cases() {
    constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    constexpr auto kInvalid = grpc::StatusCode::INVALID_ARGUMENT;
    constexpr auto kExhausted = grpc::StatusCode::RESOURCE_EXHAUSTED;
    using F = v1::FrameRequest;
    return {
        {"no scene", [](F& f) { f.clear_scene(); }, kInvalid, "frame.scene is missing"},
        {"no layers", [](F& f) { f.mutable_scene()->clear_layers(); }, kInvalid, "layers is empty"},
        {"nine layers",
         [](F& f) {
             for (int i = 0; i < 8; ++i) *f.mutable_scene()->add_layers() = f.scene().layers(0);
         },
         kExhausted, "9 layers"},
        {"layer without content", [](F& f) { f.mutable_scene()->mutable_layers(0)->clear_glyphs(); }, kInvalid,
         "layers[0].glyphs is missing"},
        {"no camera", [](F& f) { f.clear_camera(); }, kInvalid, "frame.camera is missing"},
        {"no eye", [](F& f) { f.mutable_camera()->clear_eye_mm(); }, kInvalid, "camera.eye_mm is missing"},
        {"NaN eye", [](F& f) { f.mutable_camera()->mutable_eye_mm()->set_y(kNaN); }, kInvalid, "eye_mm is ("},
        {"infinite target", [](F& f) { f.mutable_camera()->mutable_target_mm()->set_y(kInfinity); }, kInvalid, "target_mm"},
        {"eye at target", [](F& f) { *f.mutable_camera()->mutable_eye_mm() = f.camera().target_mm(); }, kInvalid, "differ"},
        {"eye too far", [](F& f) { f.mutable_camera()->mutable_eye_mm()->set_y(1e30); }, kInvalid, "1e+30"},
        {"zero up", [](F& f) { f.mutable_camera()->mutable_up()->set_z(0); }, kInvalid, "up is ("},
        {"up along the sight", [](F& f) { *f.mutable_camera()->mutable_up() = f.camera().eye_mm(); }, kInvalid, "parallel"},
        {"no lens", [](F& f) { f.mutable_camera()->clear_lens(); }, kInvalid, "field_of_view_deg"},
        {"half a circle", [](F& f) { f.mutable_camera()->set_field_of_view_deg(180); }, kInvalid, "180"},
        {"NaN height", [](F& f) { f.mutable_camera()->set_height_mm(kNaN); }, kInvalid, "height_mm"},
        {"clip reversed", [](F& f) { f.mutable_camera()->mutable_clip()->set_nearest_mm(5); }, kInvalid, "clip"},
        {"no size", [](F& f) { f.clear_width(); }, kInvalid, "0x64"},
        {"too wide", [](F& f) { f.set_width(10'000); }, kExhausted, "10000x64"},
        {"far too wide", [](F& f) { f.set_width(4'000'000'000U); }, kInvalid, "4000000000"},
        {"too many pixels", [](F& f) { f.set_width(8192), f.set_height(8192); }, kExhausted, "8192x8192"},
        {"no samples", [](F& f) { f.mutable_quality()->set_samples(0); }, kInvalid, "samples is 0"},
        {"many samples", [](F& f) { f.mutable_quality()->set_samples(65); }, kInvalid, "samples is 65"},
        {"JPEG quality", [](F& f) { f.mutable_quality()->set_jpeg_quality(101); }, kInvalid, "101"},
        {"unknown method", [](F& f) { f.mutable_quality()->set_intersection(static_cast<v1::IntersectionMethod>(99)); },
         kInvalid, "quality.intersection is 99"},
        {"no pieces", [](F& f) { f.mutable_quality()->mutable_ray_march()->set_steps(0); }, kInvalid, "ray_march.steps is 0"},
        {"many pieces", [](F& f) { f.mutable_quality()->mutable_ray_march()->set_steps(4'000'000'000U); }, kInvalid,
         "4000000000"},
        {"NaN tolerance", [](F& f) { f.mutable_quality()->mutable_polynomial()->set_tolerance(kNaN); }, kInvalid, "tolerance"},
        {"unknown traversal", [](F& f) { f.mutable_quality()->set_traversal(static_cast<v1::Traversal>(9)); }, kInvalid,
         "quality.traversal is 9"},
        {"unknown plane", [](F& f) { glyphs(f)->mutable_selection()->mutable_slice()->set_plane(static_cast<v1::Plane>(-3)); },
         kInvalid, "slice.plane is -3"},
        {"oblique without normal", [](F& f) { glyphs(f)->mutable_selection()->mutable_slice()->set_plane(v1::PLANE_OBLIQUE); },
         kInvalid, "normal is missing"},
        {"slab without thickness", [](F& f) { glyphs(f)->mutable_selection()->mutable_slab(); }, kInvalid, "thickness_mm"},
        {"NaN factor", [](F& f) { glyphs(f)->mutable_scale()->set_factor(std::nanf("")); }, kInvalid, "factor"},
        {"lmax 17", [](F& f) { glyphs(f)->set_lmax(17); }, kInvalid, "lmax is 17"},
        {"unknown tensor shape",
         [](F& f) {
             const v1::GlyphLayer kept = *glyphs(f);
             auto* tensors = f.mutable_scene()->mutable_layers(0)->mutable_tensor_glyphs();
             *tensors->mutable_glyphs() = kept;
             tensors->set_shape(static_cast<v1::TensorShape>(7));
         },
         kInvalid, "tensor_glyphs.shape is 7"},
        {"step 0", [](F& f) { f.mutable_quality()->mutable_tensor_march()->set_step(0); }, kInvalid, "tensor_march.step"},
        {"NaN step", [](F& f) { f.mutable_quality()->mutable_tensor_march()->set_step(std::nanf("")); }, kInvalid,
         "tensor_march.step"},
        {"many bisections", [](F& f) { f.mutable_quality()->mutable_tensor_march()->set_bisections(4'000'000'000U); }, kInvalid,
         "tensor_march.bisections"},
        {"depth 17", [](F& f) { f.mutable_quality()->mutable_tensor_march()->set_depth(17); }, kInvalid,
         "tensor_march.depth is 17"},
        {"uncertainty of nothing", [](F& f) { glyphs(f)->mutable_uncertainty(); }, kInvalid, "uncertainty.dataset_id is empty"},
        {"extinction 0", [](F& f) { uncertainty(f)->set_extinction_per_mm(0); }, kInvalid, "extinction_per_mm is 0"},
        {"negative extinction", [](F& f) { uncertainty(f)->set_extinction_per_mm(-2); }, kInvalid, "extinction_per_mm is -2"},
        {"NaN extinction", [](F& f) { uncertainty(f)->set_extinction_per_mm(std::nanf("")); }, kInvalid,
         "extinction_per_mm is"},
        {"deviations of glyphs", [](F& f) { uncertainty(f)->set_deviations(2); }, kInvalid, "its kind is not deviations"},
        {"no deviations",
         [](F& f) {
             uncertainty(f)->set_kind(v1::Uncertainty::KIND_DEVIATIONS);
             uncertainty(f)->set_deviations(0);
         },
         kInvalid, "deviations is 0"},
        {"unknown kind", [](F& f) { uncertainty(f)->set_kind(static_cast<v1::Uncertainty::Kind>(7)); }, kInvalid,
         "uncertainty.kind is 7"},
        {"bright emission", [](F& f) { uncertainty(f)->mutable_emission()->set_x(3); }, kInvalid, "emission is (3, "},
        {"isotropic part", [](F& f) { glyphs(f)->set_isotropic_part(-1); }, kInvalid, "isotropic_part is -1"},
        {"opacity", [](F& f) { f.mutable_scene()->mutable_layers(0)->set_opacity(0); }, kInvalid, "opacity"},
        {"zero light", [](F& f) { f.mutable_scene()->mutable_light()->mutable_direction_camera(); }, kInvalid,
         "direction_camera"},
        {"no light radius", [](F& f) { f.mutable_scene()->mutable_light()->set_angular_radius_deg(0); }, kInvalid,
         "angular_radius_deg is 0"},
        {"NaN light radius", [](F& f) { f.mutable_scene()->mutable_light()->set_angular_radius_deg(std::nanf("")); }, kInvalid,
         "angular_radius_deg is nan"},
        {"many shadow rays", [](F& f) { f.mutable_scene()->mutable_light()->set_shadow_rays(10000); }, kInvalid,
         "shadow_rays is 10000; it must be 1 to 32"},
        {"unknown shadow", [](F& f) { f.mutable_scene()->mutable_light()->set_shadow(static_cast<v1::Shadow>(7)); }, kInvalid,
         "light.shadow is 7"},
        {"no occlusion rays", [](F& f) { f.mutable_scene()->mutable_light()->mutable_ambient_occlusion()->set_rays(0); },
         kInvalid, "ambient_occlusion.rays is 0"},
        {"two lights",
         [](F& f) {
             f.mutable_scene()->mutable_light()->mutable_direction_camera()->set_z(1);
             f.mutable_scene()->mutable_light()->mutable_direction_world()->set_z(1);
         },
         kInvalid, "both direction_camera and direction_world"},
        {"background", [](F& f) { f.mutable_scene()->mutable_background()->set_x(2); }, kInvalid, "background"},
        {"unknown dataset", [](F& f) { glyphs(f)->set_dataset_id("nobody"); }, grpc::StatusCode::NOT_FOUND, "nobody"},
        {"path for a dataset", [](F& f) { glyphs(f)->set_dataset_id("../etc/passwd"); }, grpc::StatusCode::NOT_FOUND,
         "catalogue"},
    };
}

TEST(BadRequest, OpenAndRenderRefuseInWords) {
    Rig rig;
    const auto channel = rig.channel();
    Viewer other(channel, frameRequest());
    const auto renderer = v1::RenderService::NewStub(channel);
    for (const Case& bad : cases()) {
        SCOPED_TRACE(bad.name);
        v1::RenderRequest request;
        *request.mutable_frame() = frameRequest();
        bad.spoil(*request.mutable_frame());
        grpc::ClientContext context;
        v1::RenderResponse response;
        const grpc::Status status = renderer->Render(&context, request, &response);
        EXPECT_EQ(status.error_code(), bad.code) << status.error_message();
        EXPECT_THAT(status.error_message(), HasSubstr(bad.sentence));
        Viewer viewer(channel, request.frame());
        EXPECT_EQ(viewer.end().error_code(), bad.code) << viewer.end().error_message();
        EXPECT_THAT(viewer.end().error_message(), HasSubstr(bad.sentence));
    }
    ASSERT_TRUE(other.move(1, 0.5).ok());
    EXPECT_TRUE(other.waitFor([](const v1::Frame& f) { return f.camera_sequence() == 1; }));
}

TEST(BadRequest, RefusedUpdateLeavesTheViewAsItWas) {
    Rig rig;
    Viewer viewer(rig.channel(), frameRequest());
    ASSERT_TRUE(viewer.waitFor([](const v1::Frame& f) { return f.state() == v1::FRAME_STATE_CONVERGED; }));
    const std::size_t before = viewer.received();
    const auto refused = [&](const std::function<void(v1::UpdateRequest&)>& fill, grpc::StatusCode code, const char* sentence) {
        v1::UpdateRequest change;
        change.set_camera_sequence(3);
        fill(change);
        const grpc::Status status = viewer.update(change);
        EXPECT_EQ(status.error_code(), code) << status.error_message();
        EXPECT_THAT(status.error_message(), HasSubstr(sentence));
    };
    constexpr auto kInvalid = grpc::StatusCode::INVALID_ARGUMENT;
    refused([](v1::UpdateRequest& u) { *u.mutable_camera() = camera(std::nan("")); }, kInvalid, "eye_mm");
    refused([](v1::UpdateRequest& u) { u.set_width(50); }, kInvalid, "give both or none");
    refused([](v1::UpdateRequest& u) { u.set_width(9000), u.set_height(9000); }, grpc::StatusCode::RESOURCE_EXHAUSTED,
            "9000x9000");
    refused([](v1::UpdateRequest& u) { u.set_acknowledged_sequence(1000); }, kInvalid, "acknowledged_sequence is 1000");
    refused(
        [](v1::UpdateRequest& u) {
            *u.mutable_camera() = camera(1);
            u.mutable_scene()->add_layers()->mutable_glyphs()->set_dataset_id("nobody");
        },
        grpc::StatusCode::NOT_FOUND, "nobody");
    std::this_thread::sleep_for(milliseconds(300));
    EXPECT_EQ(viewer.received(), before);
    ASSERT_TRUE(viewer.move(1, 0.5).ok()) << "refused numbers do not count";
    const auto frame = viewer.waitFor([](const v1::Frame& f) { return f.camera_sequence() == 1; });
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->width(), 96U);
}

TEST(BadRequest, UnknownViewsAreNotFound) {
    Rig rig;
    const auto channel = rig.channel();
    Viewer viewer(channel, frameRequest());
    const std::string id = viewer.id();
    auto stub = v1::ViewService::NewStub(channel);
    for (const std::string& wrong : {std::string(), std::string("1"), id.substr(1), id + "0", std::string(100'000, 'a')}) {
        grpc::ClientContext context;
        v1::UpdateRequest request;
        request.set_view_id(wrong);
        v1::UpdateResponse response;
        EXPECT_EQ(stub->Update(&context, request, &response).error_code(), grpc::StatusCode::NOT_FOUND);
    }
}

TEST(BadRequest, WindowIsBounded) {
    Rig rig;
    const auto channel = rig.channel();
    for (const std::uint32_t window : {0U, 9U, 4'000'000'000U}) {
        v1::OpenRequest open;
        *open.mutable_frame() = frameRequest();
        open.set_window(window);
        Viewer viewer(channel, open, Viewer::Acknowledge::kAll);
        EXPECT_EQ(viewer.end().error_code(), grpc::StatusCode::INVALID_ARGUMENT);
        EXPECT_THAT(viewer.end().error_message(), HasSubstr("window is " + std::to_string(window)));
    }
}

TEST(BadRequest, OutputsAreKnownAndNamedOnce) {
    Rig rig;
    const auto renderer = v1::RenderService::NewStub(rig.channel());
    const auto refused = [&](const std::vector<int>& outputs, int format, const char* sentence) {
        v1::RenderRequest request;
        *request.mutable_frame() = frameRequest();
        for (const int output : outputs) request.add_outputs(static_cast<v1::Output>(output));
        request.set_format(static_cast<v1::ImageFormat>(format));
        grpc::ClientContext context;
        v1::RenderResponse response;
        const grpc::Status status = renderer->Render(&context, request, &response);
        EXPECT_EQ(status.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
        EXPECT_THAT(status.error_message(), HasSubstr(sentence));
    };
    refused({0}, 0, "outputs[0] is 0");
    refused({1, 77}, 0, "outputs[1] is 77");
    refused({1, 1}, 0, "for the second time");
    refused({}, 12, "format is 12");
}

constexpr const char* kMethods[] = {"/radiata.v1.ViewService/Open",          "/radiata.v1.ViewService/Update",
                                    "/radiata.v1.RenderService/Render",      "/radiata.v1.CatalogService/ListDatasets",
                                    "/radiata.v1.CatalogService/GetDataset", "/radiata.v1.CatalogService/FitCamera",
                                    "/radiata.v1.LimitsService/GetLimits"};

TEST(BadRequest, MalformedBytesAreNamed) {
    Rig rig;
    const auto channel = rig.channel();
    for (const char* method : kMethods) {
        const GenericAnswer answer = genericCall(channel, method, "\xff\xff\xff not protobuf");
        EXPECT_EQ(answer.status.error_code(), grpc::StatusCode::INVALID_ARGUMENT) << method;
        EXPECT_THAT(answer.status.error_message(), HasSubstr("no valid radiata.v1."));
    }
}

TEST(BadRequest, RandomDamageNeverEndsTheServer) {
    Rig rig;
    const auto channel = rig.channel();
    std::mt19937 random(11);
    v1::RenderRequest request;
    *request.mutable_frame() = frameRequest(0, 16, 16);
    request.mutable_frame()->mutable_quality()->set_samples(1);
    const std::string good = request.SerializeAsString();
    for (int i = 0; i < 300; ++i) {
        std::string bytes = good;
        for (int k = 0; k < 4; ++k) bytes[random() % bytes.size()] = static_cast<char>(random());
        if (i % 3 == 0) bytes.resize(random() % bytes.size());
        const GenericAnswer answer = genericCall(channel, "/radiata.v1.RenderService/Render", bytes);
        EXPECT_NE(answer.status.error_code(), grpc::StatusCode::INTERNAL) << answer.status.error_message();
        EXPECT_NE(answer.status.error_code(), grpc::StatusCode::UNKNOWN) << answer.status.error_message();
    }
    Viewer viewer(channel, frameRequest());
    EXPECT_TRUE(viewer.waitFor([](const v1::Frame&) { return true; }));
}

TEST(BadRequest, MessagesOverTheLimitAreRefused) {
    Rig rig;
    const auto channel = rig.channel();
    for (const char* method : kMethods) {
        const GenericAnswer answer = genericCall(channel, method, std::string(2 << 20, '\0'));
        EXPECT_EQ(answer.status.error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED) << method;
    }
}

}  // namespace
}  // namespace radiata::service::testing
