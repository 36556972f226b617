// A picture depends on its request alone: not on batches of samples, on what was drawn before, or on the buffers it is drawn
// in.
#include "image/fixture.h"

namespace radiata::test {
namespace {

class Bytes : public ImageTest {
protected:
    model::FrameRequest brain(glm::dvec3 towards) {
        model::FrameRequest request = requestOf("brain", 160, 120, 1);
        request.scene.layers[0].glyphs().scale = {};
        request.camera = cameraAround(image, towards, true);
        request.quality.samples = 6;
        return request;
    }
    const model::ShImage image = phantomImage(16, 4);
};

TEST_F(Bytes, AreEqualHoweverTheSamplesAreSplit) {
    store.add("brain", image);
    const model::FrameRequest request = brain({1, 2, 3});
    const model::Frame whole = renderer.renderAll(request);
    EXPECT_EQ(whole.info.state, model::FrameState::kConverged);
    ASSERT_GT(whole.info.hit_pixels, 2000U);
    for (const std::vector<int>& batches : {std::vector<int>{1, 5}, {2, 3, 1}, {1, 1, 1, 1, 1, 1}}) {
        render::Target target;
        model::Frame frame;
        int done = 0;
        for (const int count : batches) {
            frame = renderer.render(target, request, done, count);
            done += count;
            EXPECT_EQ(frame.info.samples, done);
            EXPECT_EQ(frame.info.state, done == 6                 ? model::FrameState::kConverged
                                        : done == batches.front() ? model::FrameState::kInteractive
                                                                  : model::FrameState::kRefining);
            if (done < 6) {
                EXPECT_NE(frame.pixels.rgba, whole.pixels.rgba) << "samples are missing still";
            }
        }
        EXPECT_EQ(frame.pixels.rgba, whole.pixels.rgba);
    }
}

TEST_F(Bytes, AreEqualAfterOtherPictures) {
    store.add("brain", image);
    store.add("field", randomField({4, true}, {3, 3, 3}, 1, obliqueAffine()));
    const model::FrameRequest request = brain({1, 2, 3});
    const model::Frame first = renderer.renderAll(request, everything());
    render::Target used;
    model::FrameRequest other = requestOf("field", 333, 77, 2);
    other.camera = cameraAround(randomField({0, false}, {3, 3, 3}, 1, obliqueAffine()), {3, 1, 1}, false);
    other.scene.background = glm::vec3(1);
    renderer.render(used, other, 0, 1);
    for (int i = 0; i < 3; ++i) {
        model::FrameRequest turned = brain({1, 2 - i, 3});
        turned.scene.layers[0].glyphs().lmax = 2;
        turned.scene.layers[0].opacity = 0.5F;
        turned.quality.samples = 2;
        turned.quality.traversal = i == 0 ? model::Traversal::kBvh : model::Traversal::kTiles;
        renderer.renderAll(turned);
        renderer.render(used, turned, 0, 1);
    }
    const model::Frame again = renderer.renderAll(request, everything());
    const model::Frame elsewhere = renderer.render(used, request, 0, 6, everything());
    for (const model::Frame* frame : {&again, &elsewhere}) {
        EXPECT_EQ(first.pixels.rgba, frame->pixels.rgba);
        EXPECT_EQ(first.pixels.depth, frame->pixels.depth);
        EXPECT_EQ(first.pixels.id, frame->pixels.id);
        EXPECT_EQ(first.pixels.normal, frame->pixels.normal);
        EXPECT_EQ(first.pixels.steps, frame->pixels.steps);
        EXPECT_EQ(first.info.hit_pixels, frame->info.hit_pixels);
    }
}

TEST_F(Bytes, AreThoseOfTheEchoedRequest) {
    store.add("brain", image);
    const model::Frame asked = renderer.renderAll(brain({3, -1, 1}));
    EXPECT_NE(asked.info.request.quality.traversal, model::Traversal::kAuto);
    EXPECT_NE(asked.info.request.quality.pole_table, model::PoleTable::kAuto);
    const model::Frame replayed = renderer.renderAll(asked.info.request);
    EXPECT_EQ(asked.pixels.rgba, replayed.pixels.rgba);
    EXPECT_EQ(asked.info.request, replayed.info.request);
}

TEST_F(Bytes, AreRefusedIfTheyContinueAnotherPicture) {
    store.add("brain", image);
    const model::FrameRequest request = brain({1, 2, 3});
    render::Target target;
    EXPECT_EQ(codeOf([&] { renderer.render(target, request, 1, 1); }), Code::kInternal);
    renderer.render(target, request, 0, 2);
    EXPECT_EQ(codeOf([&] { renderer.render(target, brain({1, 2, 4}), 2, 1); }), Code::kInternal);
    EXPECT_EQ(renderer.render(target, request, 2, 1).info.samples, 3);
}

}  // namespace
}  // namespace radiata::test
