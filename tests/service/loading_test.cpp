// Reading a large dataset holds up those who asked for it, and nobody else.
#include <atomic>
#include <future>

#include <gmock/gmock.h>

#include "service/service_fixture.h"

namespace radiata::service::testing {
namespace {

using ::testing::HasSubstr;

/// A stub with a second dataset, "large", which is there once the gate opens, or turns out to be broken.
struct Large {
    std::promise<void> gate;
    std::shared_future<void> opened = gate.get_future().share();
    std::atomic<bool> there{false};
    std::atomic<int> loads{0};

    static bool wanted(const model::FrameRequest& request) { return request.scene.layers.at(0).datasetId() == "large"; }

    session::Backend backend(bool broken = false) {
        session::Backend backend = session::stubBackend(milliseconds(1));
        backend.resident = [known = backend.resident, this](const model::FrameRequest& request) {
            return wanted(request) ? there.load() : known(request);
        };
        backend.load = [this, broken](const model::FrameRequest&) {
            ++loads;
            opened.wait();
            if (broken) throw Error(Code::kInvalidArgument, "large.nii: it ends after 12 bytes");
            there = true;
        };
        backend.render = [draw = backend.render, this](std::uint64_t view, const model::FrameRequest& request, int first,
                                                       int count, const model::Outputs& outputs,
                                                       const std::atomic<bool>* cancel) {
            if (wanted(request) && !there) throw Error(Code::kInternal, "drawn before its data was there");
            model::FrameRequest known = request;
            std::visit([](auto& layer) { layer.dataset_id = "stub"; }, known.scene.layers.at(0).content);
            return draw(view, known, first, count, outputs, cancel);
        };
        return backend;
    }
};

v1::FrameRequest largeRequest() {
    v1::FrameRequest request = frameRequest();
    request.mutable_scene()->mutable_layers(0)->mutable_glyphs()->set_dataset_id("large");
    return request;
}

bool any(const v1::Frame&) { return true; }

grpc::Status render(const std::shared_ptr<grpc::Channel>& channel, const v1::FrameRequest& frame) {
    grpc::ClientContext context;
    context.set_deadline(std::chrono::system_clock::now() + std::chrono::seconds(10));
    v1::RenderRequest request;
    *request.mutable_frame() = frame;
    v1::RenderResponse response;
    return v1::RenderService::NewStub(channel)->Render(&context, request, &response);
}

TEST(Loading, OtherViewsAndPicturesGoOn) {
    Large large;
    Rig rig(large.backend());
    Viewer waiting(rig.channel(), largeRequest());
    EXPECT_FALSE(waiting.id().empty()) << "the view is open before its data is there";
    std::future<grpc::Status> picture = std::async(std::launch::async, [&] { return render(rig.channel(), largeRequest()); });
    Viewer other(rig.channel(), frameRequest());
    ASSERT_TRUE(other.waitFor(any));
    ASSERT_TRUE(other.move(1, 0.5).ok());
    EXPECT_TRUE(other.waitFor([](const v1::Frame& frame) { return frame.camera_sequence() == 1; }));
    EXPECT_TRUE(render(rig.channel(), frameRequest()).ok());
    EXPECT_EQ(waiting.received(), 0U);
    large.gate.set_value();
    EXPECT_TRUE(waiting.waitFor(any));
    EXPECT_TRUE(picture.get().ok());
}

TEST(Loading, ScenesOfWhatIsThereChangeWhileAllReadersAreBusy) {
    Large large;
    Rig rig(large.backend());
    const auto wish = [](const v1::FrameRequest& frame, float red) {
        v1::UpdateRequest update;
        *update.mutable_scene() = frame.scene();
        update.mutable_scene()->mutable_background()->set_x(red);
        return update;
    };
    std::vector<std::unique_ptr<Viewer>> viewers;
    std::vector<std::future<grpc::Status>> waiting;
    for (int i = 0; i < 4; ++i) {
        Viewer& viewer = *viewers.emplace_back(std::make_unique<Viewer>(rig.channel(), frameRequest()));
        ASSERT_TRUE(viewer.waitFor(any));
        waiting.push_back(std::async(std::launch::async, [&] { return viewer.update(wish(largeRequest(), 0)); }));
    }
    while (large.loads < 2) std::this_thread::sleep_for(milliseconds(1));
    Viewer other(rig.channel(), frameRequest());
    EXPECT_TRUE(other.update(wish(frameRequest(), 0.5F)).ok());
    large.gate.set_value();
    for (auto& status : waiting) EXPECT_TRUE(status.get().ok());
}

TEST(Loading, AMethodThatNeedsWorkBeforeItsFirstPictureHoldsUpItsOwnViewOnly) {
    std::promise<void> gate;
    std::shared_future<void> opened = gate.get_future().share();
    std::atomic<bool> there{false};
    session::Backend backend = session::stubBackend(milliseconds(1));
    const auto triangles = [](const model::FrameRequest& request) {
        return request.quality.isosurface.method == model::SurfaceMethod::kMarchingCubes;
    };
    backend.resident = [&](const model::FrameRequest& request) { return !triangles(request) || there; };
    backend.load = [&](const model::FrameRequest&) {
        opened.wait();
        there = true;
    };
    backend.render = [&, draw = backend.render](std::uint64_t view, const model::FrameRequest& request, int first, int count,
                                                const model::Outputs& outputs, const std::atomic<bool>* cancel) {
        if (triangles(request) && !there) throw Error(Code::kInternal, "drawn before its triangles were there");
        return draw(view, request, first, count, outputs, cancel);
    };
    Rig rig(std::move(backend));
    Viewer changing(rig.channel(), frameRequest()), other(rig.channel(), frameRequest());
    ASSERT_TRUE(changing.waitFor(any));
    ASSERT_TRUE(other.waitFor(any));
    v1::UpdateRequest update;
    update.set_camera_sequence(7);
    *update.mutable_quality() = frameRequest().quality();
    update.mutable_quality()->mutable_isosurface()->set_method(v1::SURFACE_METHOD_MARCHING_CUBES);
    ASSERT_TRUE(changing.update(update).ok());
    ASSERT_TRUE(other.move(1, 0.5).ok());
    EXPECT_TRUE(other.waitFor([](const v1::Frame& frame) { return frame.camera_sequence() == 1; }));
    EXPECT_FALSE(there);
    gate.set_value();
    EXPECT_TRUE(changing.waitFor([](const v1::Frame& frame) {
        return frame.request().quality().isosurface().method() == v1::SURFACE_METHOD_MARCHING_CUBES;
    }));
}

TEST(Loading, WhoDragsASettingWaitsForItsLastValueOnly) {
    std::promise<void> gate;
    std::shared_future<void> opened = gate.get_future().share();
    std::atomic<float> there{0.5F};  // the step, in place of whatever something is made for
    std::atomic<int> loads{0};
    session::Backend backend = session::stubBackend(milliseconds(1));
    backend.resident = [&](const model::FrameRequest& request) { return request.quality.isosurface.step == there; };
    backend.load = [&](const model::FrameRequest& request) {
        ++loads;
        opened.wait();
        there = request.quality.isosurface.step;
    };
    Rig rig(std::move(backend));
    Viewer viewer(rig.channel(), frameRequest());
    ASSERT_TRUE(viewer.waitFor(any));
    v1::UpdateRequest update;
    *update.mutable_quality() = frameRequest().quality();
    for (std::uint64_t step = 1; step <= 9; ++step) {
        update.set_camera_sequence(step);
        update.mutable_quality()->mutable_isosurface()->set_step(0.5F + 0.25F * static_cast<float>(step));
        ASSERT_TRUE(viewer.update(update).ok());
    }
    gate.set_value();
    EXPECT_TRUE(viewer.waitFor(
        [](const v1::Frame& frame) { return frame.request().quality().isosurface().step() == 0.5F + 0.25F * 9; }));
    EXPECT_EQ(loads, 2) << "the first value's, and the last one's";
}

TEST(Loading, ABrokenFileEndsTheViewWithItsSentence) {
    Large large;
    Rig rig(large.backend(true));
    Viewer waiting(rig.channel(), largeRequest());
    large.gate.set_value();
    const grpc::Status status = waiting.end();
    EXPECT_EQ(status.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
    EXPECT_THAT(status.error_message(), HasSubstr("ends after 12 bytes"));
    EXPECT_THAT(render(rig.channel(), largeRequest()).error_message(), HasSubstr("ends after 12 bytes"));
    EXPECT_TRUE(render(rig.channel(), frameRequest()).ok());
}

TEST(Loading, AClosedViewAndAStoppedServerWaitForNothing) {
    Large large;
    {
        Rig rig(large.backend());
        {
            Viewer waiting(rig.channel(), largeRequest());
            EXPECT_FALSE(waiting.id().empty());
        }  // cancelled while its data is read
        Viewer other(rig.channel(), frameRequest());
        EXPECT_TRUE(other.waitFor(any));
        large.gate.set_value();
    }
    EXPECT_EQ(large.loads, 1);
}

}  // namespace
}  // namespace radiata::service::testing
