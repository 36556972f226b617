// Picks through the service: on frames of views, on pictures of their own, and everything that can be wrong with one.
#include <gmock/gmock.h>

#include "radiata/v1/pick.grpc.pb.h"
#include "service/service_fixture.h"
#include "session/view.h"

namespace radiata::service::testing {
namespace {

using ::testing::HasSubstr;

grpc::Status pick(const std::shared_ptr<grpc::Channel>& channel, const v1::PickRequest& request, v1::PickResponse& response) {
    grpc::ClientContext context;
    context.set_deadline(std::chrono::system_clock::now() + std::chrono::seconds(30));
    return v1::PickService::NewStub(channel)->Pick(&context, request, &response);
}

void expectRefused(const std::shared_ptr<grpc::Channel>& channel, const v1::PickRequest& request, grpc::StatusCode code,
                   const std::string& words) {
    v1::PickResponse response;
    const grpc::Status status = pick(channel, request, response);
    EXPECT_EQ(status.error_code(), code) << status.error_message();
    EXPECT_THAT(status.error_message(), HasSubstr(words));
}

/// The stub's glyph has f = 0.282 - 0.273 (x^2 - y^2), so its one peak is y.
TEST(Pick, OfAPictureOfItsOwnNamesThePlaceAndThePeak) {
    Rig rig;
    v1::PickRequest request;
    *request.mutable_request() = frameRequest();
    request.set_x(3);
    request.set_y(5);
    v1::PickResponse response;
    const grpc::Status status = pick(rig.channel(), request, response);
    ASSERT_TRUE(status.ok()) << status.error_message();
    ASSERT_TRUE(response.has_glyph());
    const v1::PickedGlyph& glyph = response.glyph();
    EXPECT_EQ(glyph.dataset_id(), "stub");
    EXPECT_THAT(glyph.voxel(), ::testing::ElementsAre(3, 5, 0));
    EXPECT_DOUBLE_EQ(glyph.direction().z(), 0.8);
    EXPECT_NEAR(glyph.amplitude(), 0.28209479 + 0.27313710 * 0.36, 1e-6);
    EXPECT_NEAR(glyph.position_mm().y(), glyph.centre_mm().y() + 0.6 * glyph.radius_mm(), 1e-9);
    ASSERT_EQ(glyph.peaks_size(), 1);
    EXPECT_NEAR(glyph.peaks(0).direction().y(), 1, 1e-12) << "the end that is nearer to the direction";
    EXPECT_NEAR(glyph.peaks(0).amplitude(), 0.28209479 + 0.27313710, 1e-6);
    EXPECT_EQ(glyph.peak_rank(), 1U);
    EXPECT_NEAR(glyph.peak_angle_deg(), 53.1301, 1e-3);
    request.set_x(95);
    ASSERT_TRUE(pick(rig.channel(), request, response).ok());
    EXPECT_FALSE(response.has_glyph()) << "nothing there is an answer";
}

TEST(Pick, AnswersWithAllHitsIfAskedTo) {
    Rig rig;
    v1::PickRequest request;
    *request.mutable_request() = frameRequest();
    request.set_x(3);
    request.set_y(5);
    v1::PickResponse response;
    ASSERT_TRUE(pick(rig.channel(), request, response).ok());
    EXPECT_EQ(response.glyph().hits_size(), 0);
    request.set_all_hits(true);
    ASSERT_TRUE(pick(rig.channel(), request, response).ok());
    const v1::PickedGlyph& glyph = response.glyph();
    ASSERT_EQ(glyph.hits_size(), 2);
    EXPECT_DOUBLE_EQ(glyph.hits(0).position_mm().y(), glyph.position_mm().y());
    EXPECT_DOUBLE_EQ(glyph.hits(1).direction().z(), -0.8);
    EXPECT_DOUBLE_EQ(glyph.hits(1).distance_mm() - glyph.hits(0).distance_mm(), 2 * glyph.radius_mm());
    EXPECT_DOUBLE_EQ(glyph.hits(1).radius_mm(), glyph.radius_mm());
    EXPECT_FALSE(glyph.hits(0).leaving() || glyph.hits(0).negative_lobe());
    EXPECT_TRUE(glyph.hits(1).leaving());
    for (const auto method : {v1::INTERSECTION_METHOD_RAY_MARCH_PEETERS, v1::INTERSECTION_METHOD_TENSOR_MARCH,
                              v1::INTERSECTION_METHOD_TESSELLATED}) {
        request.mutable_request()->mutable_quality()->set_intersection(method);
        expectRefused(rig.channel(), request, grpc::StatusCode::INVALID_ARGUMENT,
                      "first hit; all hits are found by march, pole-table, polynomial, polynomial-double, laguerre");
    }
}

TEST(Pick, OfAViewsFrameAnswersForThatFrame) {
    Rig rig;
    const auto channel = rig.channel();
    Viewer viewer(channel, frameRequest(0, 96, 64));
    ASSERT_TRUE(viewer.waitFor([](const v1::Frame& frame) { return frame.state() == v1::FRAME_STATE_CONVERGED; }));
    v1::PickRequest request;
    request.mutable_view()->set_view_id(viewer.id());
    request.mutable_view()->set_sequence(1);
    request.set_x(47);
    request.set_y(63);
    v1::PickResponse response;
    ASSERT_TRUE(pick(channel, request, response).ok());
    EXPECT_EQ(response.glyph().voxel(0), 47U);
    // The view is made narrower: its old frames keep their own pixels, the new ones have fewer.
    v1::UpdateRequest change;
    change.set_width(32);
    change.set_height(64);
    change.set_camera_sequence(1);
    ASSERT_TRUE(viewer.update(change).ok());
    const auto narrow = viewer.waitFor([](const v1::Frame& frame) { return frame.width() == 32; });
    ASSERT_TRUE(narrow);
    ASSERT_TRUE(pick(channel, request, response).ok());
    EXPECT_EQ(response.glyph().voxel(0), 47U);
    request.mutable_view()->set_sequence(narrow->sequence());
    expectRefused(channel, request, grpc::StatusCode::INVALID_ARGUMENT, "47, 63 lies outside the picture of 32 x 64");
    request.mutable_view()->set_sequence(9999);
    expectRefused(channel, request, grpc::StatusCode::NOT_FOUND, "frame 9999 was never sent");
    request.mutable_view()->set_sequence(0);
    expectRefused(channel, request, grpc::StatusCode::NOT_FOUND, "frame 0 was never sent");
    request.mutable_view()->set_view_id("0123");
    expectRefused(channel, request, grpc::StatusCode::NOT_FOUND, "no open view");
}

TEST(Pick, OnAFrameThatIsTooOldSaysSo) {
    Rig rig;
    const auto channel = rig.channel();
    Viewer viewer(channel, frameRequest());
    for (std::uint64_t i = 1; i <= session::View::kFramesKept + 2; ++i) {
        ASSERT_TRUE(viewer.move(i, 0.01 * static_cast<double>(i)).ok());
        ASSERT_TRUE(viewer.waitFor([i](const v1::Frame& frame) { return frame.camera_sequence() == i; }));
    }
    v1::PickRequest request;
    request.mutable_view()->set_view_id(viewer.id());
    request.mutable_view()->set_sequence(1);
    expectRefused(channel, request, grpc::StatusCode::NOT_FOUND, "frame 1 is too old");
    request.mutable_view()->set_sequence(5 + session::View::kFramesKept / 2);
    v1::PickResponse response;
    EXPECT_TRUE(pick(channel, request, response).ok());
}

TEST(Pick, ThatCannotBeIsRefused) {
    Rig rig;
    v1::PickRequest request;
    expectRefused(rig.channel(), request, grpc::StatusCode::INVALID_ARGUMENT, "view");
    *request.mutable_request() = frameRequest();
    request.set_x(96);
    expectRefused(rig.channel(), request, grpc::StatusCode::INVALID_ARGUMENT, "96 x 64");
    request.set_x(4294967295U);
    expectRefused(rig.channel(), request, grpc::StatusCode::INVALID_ARGUMENT, "4294967295");
    request.set_x(0);
    request.mutable_request()->mutable_scene()->mutable_layers(0)->mutable_glyphs()->set_dataset_id("nobody");
    expectRefused(rig.channel(), request, grpc::StatusCode::NOT_FOUND, "nobody");
    request.mutable_request()->clear_camera();
    expectRefused(rig.channel(), request, grpc::StatusCode::INVALID_ARGUMENT, "request.camera");
    *request.mutable_request() = frameRequest();
    request.mutable_request()->mutable_quality()->set_samples(0);
    expectRefused(rig.channel(), request, grpc::StatusCode::INVALID_ARGUMENT, "quality.samples");
}

}  // namespace
}  // namespace radiata::service::testing
