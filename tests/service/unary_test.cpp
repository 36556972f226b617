// Pictures for scripts, catalogue, limits, health, reflection.
#include <cstring>
#include <thread>

#include <gmock/gmock.h>

#include "encode/png.h"
#include "service/generic_call.h"
#include "service/service_fixture.h"

namespace radiata::service::testing {
namespace {

using ::testing::HasSubstr;

grpc::Status render(const std::shared_ptr<grpc::Channel>& channel, const v1::RenderRequest& request,
                    v1::RenderResponse& response) {
    grpc::ClientContext context;
    context.set_deadline(std::chrono::system_clock::now() + std::chrono::seconds(20));
    return v1::RenderService::NewStub(channel)->Render(&context, request, &response);
}

v1::RenderRequest renderRequest(std::uint32_t width = 96, std::uint32_t height = 64) {
    v1::RenderRequest request;
    *request.mutable_frame() = frameRequest(0, width, height);
    return request;
}

TEST(Render, AnswersWithAllSamplesAndTheRequestFilledIn) {
    Rig rig;
    v1::RenderResponse response;
    const grpc::Status status = render(rig.channel(), renderRequest(), response);
    ASSERT_TRUE(status.ok()) << status.error_message();
    const v1::Frame& frame = response.frame();
    EXPECT_EQ(frame.sequence(), 1U);
    EXPECT_EQ(frame.samples(), 16U);
    EXPECT_EQ(frame.state(), v1::FRAME_STATE_CONVERGED);
    EXPECT_EQ(frame.format(), v1::IMAGE_FORMAT_PNG);
    EXPECT_EQ(frame.request().quality().jpeg_quality(), 90U);
    EXPECT_EQ(frame.request().scene().layers(0).opacity(), 1.0F);
    EXPECT_EQ(frame.device(), "stub");
    const auto picture = encode::decodePng({reinterpret_cast<const std::uint8_t*>(frame.image().data()), frame.image().size()});
    EXPECT_EQ(picture.width, 96);
}

TEST(Render, GivesTheWantedOutputsAndNoOthers) {
    Rig rig;
    v1::RenderRequest request = renderRequest();
    request.add_outputs(v1::OUTPUT_DEPTH);
    request.add_outputs(v1::OUTPUT_ID);
    v1::RenderResponse response;
    ASSERT_TRUE(render(rig.channel(), request, response).ok());
    ASSERT_EQ(response.frame().outputs_size(), 2);
    const v1::OutputArray& depth = response.frame().outputs(0);
    EXPECT_EQ(depth.output(), v1::OUTPUT_DEPTH);
    EXPECT_THAT(depth.shape(), ::testing::ElementsAre(64, 96));
    ASSERT_EQ(depth.data().size(), 64U * 96 * 4);
    float first = 0;
    std::memcpy(&first, depth.data().data(), 4);
    EXPECT_EQ(first, 1.5F);
    EXPECT_THAT(response.frame().outputs(1).shape(), ::testing::ElementsAre(64, 96, 4));
    EXPECT_EQ(response.frame().outputs(1).data().size(), 64U * 96 * 16);
}

TEST(Render, SamePictureForSameRequestWhileViewsMove) {
    Rig rig;
    const auto channel = rig.channel();
    Viewer viewer(channel, frameRequest());
    v1::RenderResponse first;
    v1::RenderResponse second;
    ASSERT_TRUE(render(channel, renderRequest(), first).ok());
    ASSERT_TRUE(viewer.move(1, 1.0).ok());
    ASSERT_TRUE(render(channel, renderRequest(), second).ok());
    EXPECT_EQ(first.frame().image(), second.frame().image());
}

TEST(Render, IsCancelledWithItsClient) {
    Rig rig(session::stubBackend(milliseconds(2000)));
    const auto channel = rig.channel();
    grpc::ClientContext context;
    context.set_deadline(std::chrono::system_clock::now() + milliseconds(100));
    v1::RenderResponse response;
    const grpc::Status status = v1::RenderService::NewStub(channel)->Render(&context, renderRequest(), &response);
    EXPECT_EQ(status.error_code(), grpc::StatusCode::DEADLINE_EXCEEDED);
    // The render thread is free again long before the abandoned picture would have been done.
    const auto start = std::chrono::steady_clock::now();
    Viewer viewer(channel, [] {
        v1::FrameRequest frame = frameRequest();
        frame.mutable_quality()->set_samples(1);
        return frame;
    }());
    EXPECT_TRUE(viewer.waitFor([](const v1::Frame&) { return true; }));
    EXPECT_LT(std::chrono::steady_clock::now() - start, milliseconds(2000 + 500));
}

TEST(Render, ShortPicturesDoNotWaitForTheEndOfLongOnes) {
    Rig rig(session::stubBackend(milliseconds(40)));
    const auto channel = rig.channel();
    using Clock = std::chrono::steady_clock;
    Clock::time_point long_one, short_one;
    std::thread first([&] {
        v1::RenderRequest request = renderRequest();
        request.mutable_frame()->mutable_quality()->set_samples(64);
        v1::RenderResponse response;
        EXPECT_TRUE(render(channel, request, response).ok());
        long_one = Clock::now();
    });
    std::this_thread::sleep_for(milliseconds(1200));  // longer than a job is taken for a short one
    v1::RenderRequest request = renderRequest();
    request.mutable_frame()->mutable_quality()->set_samples(2);
    v1::RenderResponse response;
    EXPECT_TRUE(render(channel, request, response).ok());
    short_one = Clock::now();
    first.join();
    EXPECT_GT(long_one - short_one, milliseconds(300));
}

TEST(Render, WaitingPicturesAreBounded) {
    session::Settings settings;
    settings.jobs_max = 1;
    Rig rig(session::stubBackend(milliseconds(50)), settings);
    const auto channel = rig.channel();
    std::thread first([&] {
        v1::RenderResponse response;
        EXPECT_TRUE(render(channel, renderRequest(), response).ok());
    });
    std::this_thread::sleep_for(milliseconds(200));
    v1::RenderResponse response;
    EXPECT_EQ(render(channel, renderRequest(), response).error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
    first.join();
}

TEST(Catalog, ListsGetsAndFits) {
    Rig rig;
    const auto stub = v1::CatalogService::NewStub(rig.channel());
    v1::ListDatasetsResponse list;
    {
        grpc::ClientContext context;
        ASSERT_TRUE(stub->ListDatasets(&context, {}, &list).ok());
    }
    ASSERT_EQ(list.datasets_size(), 1);
    const v1::Dataset& dataset = list.datasets(0);
    EXPECT_EQ(dataset.id(), "stub");
    EXPECT_EQ(dataset.kind(), v1::DATASET_KIND_SH_IMAGE);
    EXPECT_EQ(dataset.voxel_to_world().rows_size(), 12);
    EXPECT_EQ(dataset.voxel_to_world().rows(3), -90) << "row-major: the first row ends with the translation";
    {
        grpc::ClientContext context;
        v1::GetDatasetRequest request;
        request.set_id("../../etc/passwd");
        v1::GetDatasetResponse response;
        const grpc::Status status = stub->GetDataset(&context, request, &response);
        EXPECT_EQ(status.error_code(), grpc::StatusCode::NOT_FOUND);
    }
    grpc::ClientContext context;
    v1::FitCameraRequest request;
    request.set_dataset_id("stub");
    request.set_aspect(1.5);
    v1::FitCameraResponse response;
    ASSERT_TRUE(stub->FitCamera(&context, request, &response).ok());
    EXPECT_LT(response.camera().eye_mm().z(), 0) << "radiological: from the feet";
}

TEST(Catalog, RefusesOddAspectsAndSelections) {
    Rig rig;
    const auto stub = v1::CatalogService::NewStub(rig.channel());
    const auto fit = [&](const v1::FitCameraRequest& request) {
        grpc::ClientContext context;
        v1::FitCameraResponse response;
        return stub->FitCamera(&context, request, &response);
    };
    v1::FitCameraRequest request;
    request.set_dataset_id("stub");
    EXPECT_THAT(fit(request).error_message(), HasSubstr("aspect is 0.0"));
    request.set_aspect(1);
    request.mutable_selection()->mutable_slab()->set_thickness_mm(-1);
    EXPECT_EQ(fit(request).error_message(), "selection.thickness_mm is -1; it must be finite and above 0");
    request.clear_selection();
    request.set_dataset_id("nobody");
    EXPECT_EQ(fit(request).error_code(), grpc::StatusCode::NOT_FOUND);
}

TEST(Limits, ArePublished) {
    Rig rig;
    grpc::ClientContext context;
    v1::GetLimitsResponse response;
    ASSERT_TRUE(v1::LimitsService::NewStub(rig.channel())->GetLimits(&context, {}, &response).ok());
    EXPECT_EQ(response.message_bytes_max(), 1U << 20);
    EXPECT_EQ(response.window_max(), 8U);
    EXPECT_FALSE(response.version().empty());
}

TEST(Health, ServesUntilTheServerStops) {
    Rig rig;
    const GenericAnswer answer = genericCall(rig.channel(), "/grpc.health.v1.Health/Check", "");
    ASSERT_TRUE(answer.status.ok());
    EXPECT_EQ(answer.bytes, std::string("\x08\x01", 2)) << "status: SERVING";
}

TEST(Reflection, NamesTheServices) {
    Rig rig;
    const std::string list_services("\x3a\x00", 2);
    const GenericAnswer answer =
        genericCall(rig.channel(), "/grpc.reflection.v1alpha.ServerReflection/ServerReflectionInfo", list_services);
    ASSERT_TRUE(answer.status.ok()) << answer.status.error_message();
    for (const char* name : {"radiata.v1.ViewService", "radiata.v1.RenderService", "radiata.v1.CatalogService",
                             "radiata.v1.LimitsService", "grpc.health.v1.Health"}) {
        EXPECT_THAT(answer.bytes, HasSubstr(name));
    }
}

TEST(Listening, RefusesAddressesThatOthersReach) {
    for (const char* address : {"127.0.0.1:0", "localhost:50051", "[::1]:0", "127.0.0.53:1", "unix:/tmp/socket"}) {
        EXPECT_TRUE(isLoopback(address)) << address;
    }
    for (const char* address : {"0.0.0.0:0", "[::]:50051", "192.168.1.2:1", "example:1", "127.evil.example:1", ":50051"}) {
        EXPECT_FALSE(isLoopback(address)) << address;
    }
    session::Conductor conductor(session::stubBackend(milliseconds(1)), {});
    EXPECT_THROW(Server(conductor, ServerOptions{"0.0.0.0:0", false, 1 << 20}), Error);
}

TEST(Listening, TakesAFreePortAndNamesATakenOne) {
    session::Conductor conductor(session::stubBackend(milliseconds(1)), {});
    Server server(conductor, ServerOptions{"127.0.0.1:0"});
    ASSERT_GT(server.port(), 0);
    session::Conductor other(session::stubBackend(milliseconds(1)), {});
    EXPECT_THROW(Server(other, ServerOptions{"127.0.0.1:" + std::to_string(server.port())}), Error);
}

}  // namespace
}  // namespace radiata::service::testing
