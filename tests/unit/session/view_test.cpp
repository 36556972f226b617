// The state machine of one view: newest camera wins, the window holds, a resting view refines up to the lossless frame.
#include "session/view.h"

#include <gtest/gtest.h>

#include "base/error.h"

namespace radiata::session {
namespace {

using std::chrono::milliseconds;
constexpr Pace kPace{milliseconds(120), milliseconds(100)};
const Clock::time_point kStart{};

model::FrameRequest request() {
    model::FrameRequest frame;
    frame.scene.layers.emplace_back();
    frame.scene.layers[0].glyphs().dataset_id = "stub";
    return frame;
}

Change cameraChange(std::uint64_t sequence, double x) {
    Change change;
    change.camera_sequence = sequence;
    change.camera = model::Camera{};
    change.camera->eye_mm.x = x;
    return change;
}

Change acknowledge(std::uint64_t sequence) {
    Change change;
    change.acknowledged_sequence = sequence;
    return change;
}

StreamFrame picture(const View& view, const Step& step) {
    StreamFrame frame;
    frame.info.request = view.request();
    frame.info.state = step.state;
    frame.camera_sequence = step.camera_sequence;
    return frame;
}

/// Draws the next step, hands its picture over if it has one, and acknowledges it.
std::optional<Step> run(View& view, Clock::time_point now, double render_ms = 1) {
    const auto step = view.next(now);
    if (!step) return step;
    view.started(*step);
    if (view.rendered(*step, render_ms)) {
        view.offer(picture(view, *step), *step);
        const auto frame = view.take(now);
        view.apply(acknowledge(frame->sequence), now);
    }
    return step;
}

TEST(View, AnswersAtOnceThenRefinesAfterRest) {
    View view(request(), 2, kPace, kStart);
    const auto first = run(view, kStart);
    ASSERT_TRUE(first);
    EXPECT_TRUE(first->interactive);
    EXPECT_EQ(first->count, 1);
    EXPECT_FALSE(view.next(kStart + milliseconds(119)));
    EXPECT_EQ(view.wakeAt(), kStart + milliseconds(120));
    std::vector<int> sent;
    int done = 1;
    while (const auto step = run(view, kStart + milliseconds(120))) {
        EXPECT_EQ(step->first_sample, done);
        done += step->count;
        if (step->emits) sent.push_back(done);
        EXPECT_EQ(step->state == model::FrameState::kConverged, done == 16);
    }
    EXPECT_EQ(sent, (std::vector<int>{4, 8, 16}));
    EXPECT_FALSE(view.wakeAt());
}

TEST(View, SlowSamplesAreDrawnOneByOne) {
    View view(request(), 2, kPace, kStart);
    run(view, kStart, 80);
    const auto step = view.next(kStart + milliseconds(200));
    ASSERT_TRUE(step);
    EXPECT_EQ(step->count, 1);
    EXPECT_FALSE(step->emits);
}

TEST(View, OneSampleIsSentAgainWithoutLoss) {
    model::FrameRequest one = request();
    one.quality.samples = 1;
    View view(one, 2, kPace, kStart);
    EXPECT_EQ(run(view, kStart)->state, model::FrameState::kInteractive);
    const auto step = run(view, kStart + milliseconds(200));
    ASSERT_TRUE(step);
    EXPECT_EQ(step->state, model::FrameState::kConverged);
    EXPECT_EQ(step->first_sample, 0);
    EXPECT_FALSE(view.next(kStart + milliseconds(400)));
}

TEST(View, WindowHoldsUntilAcknowledged) {
    View view(request(), 2, kPace, kStart);
    for (std::uint64_t i = 1; i <= 2; ++i) {
        view.apply(cameraChange(i, static_cast<double>(i)), kStart);
        const auto step = view.next(kStart);
        ASSERT_TRUE(step);
        view.started(*step);
        EXPECT_FALSE(view.next(kStart)) << "one step at a time";
        view.rendered(*step, 1);
        view.offer(picture(view, *step), *step);
        view.take(kStart);
    }
    EXPECT_EQ(view.underWay(), 2);
    view.apply(cameraChange(3, 3), kStart);
    EXPECT_FALSE(view.next(kStart));
    view.apply(acknowledge(1), kStart);
    EXPECT_TRUE(view.next(kStart));
    EXPECT_THROW(view.apply(acknowledge(3), kStart), Error);
    EXPECT_EQ(view.underWay(), 1);
}

TEST(View, NewerPictureReplacesOneThatHasNotGone) {
    View view(request(), 2, kPace, kStart);
    Step steps[2];
    for (int i = 0; i < 2; ++i) {
        view.apply(cameraChange(static_cast<std::uint64_t>(i + 1), i + 1), kStart);
        steps[i] = *view.next(kStart);
        view.started(steps[i]);
        view.rendered(steps[i], 1);
    }
    EXPECT_TRUE(view.offer(picture(view, steps[1]), steps[1]));
    EXPECT_FALSE(view.offer(picture(view, steps[0]), steps[0])) << "overtaken while it was encoded";
    EXPECT_EQ(view.underWay(), 1);
    const auto frame = view.take(kStart);
    EXPECT_EQ(frame->camera_sequence, 2U);
    EXPECT_EQ(frame->sequence, 1U);
    EXPECT_FALSE(view.take(kStart));
}

TEST(View, SameRequestIsNotDrawnAgain) {
    View view(request(), 2, kPace, kStart);
    EXPECT_TRUE(view.apply(cameraChange(1, 5), kStart));
    EXPECT_FALSE(view.apply(cameraChange(1, 5), kStart));
    EXPECT_FALSE(view.apply(acknowledge(0), kStart));
    EXPECT_TRUE(view.apply(cameraChange(2, 5), kStart)) << "a newer number wants an answer";
}

TEST(View, OvertakenCameraIsLeftOut) {
    View view(request(), 2, kPace, kStart);
    view.apply(cameraChange(7, 7), kStart);
    EXPECT_FALSE(view.apply(cameraChange(6, 6), kStart));
    EXPECT_EQ(view.request().camera.eye_mm.x, 7);
    Change size;
    size.camera_sequence = 6;
    size.size = Size{64, 48};
    EXPECT_TRUE(view.apply(size, kStart)) << "only the camera was newer";
    EXPECT_EQ(view.request().width, 64);
}

TEST(View, RefinementOfAnOldCameraIsDropped) {
    View view(request(), 2, kPace, kStart);
    run(view, kStart);
    const auto step = view.next(kStart + milliseconds(120));
    view.started(*step);
    view.apply(cameraChange(1, 1), kStart + milliseconds(125));
    EXPECT_FALSE(view.rendered(*step, 1));
    EXPECT_EQ(view.underWay(), 0);
    EXPECT_TRUE(view.next(kStart + milliseconds(130))->interactive);
}

TEST(View, CancelledRefinementStartsAnew) {
    View view(request(), 2, kPace, kStart);
    run(view, kStart);
    const auto step = view.next(kStart + milliseconds(120));
    view.started(*step);
    view.cancelled(*step);
    EXPECT_EQ(view.underWay(), 0);
    EXPECT_EQ(view.next(kStart + milliseconds(130))->first_sample, 0);
}

TEST(View, EchoesTheRequestOnlyWhenItIsNews) {
    View view(request(), 2, kPace, kStart);
    const auto draw = [&view](Clock::time_point now) {
        const auto step = view.next(now);
        view.started(*step);
        view.rendered(*step, 1);
        view.offer(picture(view, *step), *step);
        auto frame = view.take(now);
        view.apply(acknowledge(frame->sequence), now);
        return frame->echo_request;
    };
    EXPECT_TRUE(draw(kStart));
    view.apply(cameraChange(1, 3), kStart);
    EXPECT_FALSE(draw(kStart));
    Change quality;
    quality.quality = model::Quality{};
    quality.quality->samples = 4;
    view.apply(quality, kStart);
    EXPECT_TRUE(draw(kStart));
}

}  // namespace
}  // namespace radiata::session
