// What is off costs nothing: no pass and no memory. What is no longer wanted stops soon. The validation layers have nothing to
// say.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <optional>
#include <thread>

#include "image/fixture.h"
#include "math/sh_layout.h"

namespace radiata::test {
namespace {

class Cost : public ImageTest {
protected:
    static std::vector<std::string> passNames(const model::Frame& frame) {
        std::vector<std::string> names;
        for (const model::PassTime& pass : frame.info.passes) {
            if (std::ranges::find(names, pass.name) == names.end()) names.push_back(pass.name);
        }
        return names;
    }
};

TEST_F(Cost, OfThePoleTableAndHierarchyIsNothingWhereTheyAreOff) {
    const model::ShImage image = randomField({8, false}, {12, 12, 4}, 61, obliqueAffine());
    const std::uint64_t glyphs = image.voxels.size();
    store.add("field", image);
    store.glyphs("field");
    model::FrameRequest request = requestOf("field", 64, 48, 2);
    request.camera = cameraAround(image, {1, 2, 3}, true);
    request.quality.traversal = model::Traversal::kTiles;
    request.quality.pole_table = model::PoleTable::kOff;
    request.quality.samples = 2;
    const std::uint64_t before = device.allocatedBytes();
    render::Target target;
    const model::Frame plain = renderer.render(target, request, 0, 1);
    EXPECT_EQ(passNames(plain), (std::vector<std::string>{"glyph trace", "light", "resolve"}));
    // Surface, light and picture: 24, 12 and 4 bytes a pixel; 64 bytes a glyph; the rest are tile lists and parameters.
    const std::uint64_t tiles = device.allocatedBytes() - before;
    const std::uint64_t needed = 64 * 48 * 40 + glyphs * 64;
    const std::uint64_t table_bytes = glyphs * poleTableCount(8, false) * 4;
    std::printf("tiles: %llu bytes, of which %llu are pixels and glyphs; a pole table takes %llu\n",
                static_cast<unsigned long long>(tiles), static_cast<unsigned long long>(needed),
                static_cast<unsigned long long>(table_bytes));
    EXPECT_GE(tiles, needed);
    EXPECT_LE(tiles, needed + 150'000);
    ASSERT_GT(table_bytes, 150'000U) << "or the bound above says nothing";

    request.quality.traversal = model::Traversal::kBvh;
    renderer.render(target, request, 0, 1);
    const std::uint64_t with_hierarchy = device.allocatedBytes() - before;
    EXPECT_GT(with_hierarchy, tiles + glyphs * 4) << "the hierarchy is built when it is first asked for";
    request.quality.pole_table = model::PoleTable::kOn;
    const model::Frame table = renderer.render(target, request, 0, 1);
    EXPECT_EQ(passNames(table), (std::vector<std::string>{"glyph table", "glyph trace", "light", "resolve"}));
    EXPECT_GE(device.allocatedBytes() - before, with_hierarchy + table_bytes);
    const model::Frame refined = renderer.render(target, request, 1, 1);
    EXPECT_EQ(passNames(refined), (std::vector<std::string>{"glyph trace", "light", "resolve"})) << "the table is made once";
}

/// One sample is the picture: no sum, and no pass that divides it.
TEST_F(Cost, OfFurtherSamplesIsNothingWhereThereIsOne) {
    const model::ShImage image = randomField({2, false}, {2, 2, 2}, 65, obliqueAffine());
    store.add("field", image);
    model::FrameRequest request = requestOf("field", 640, 480, 2);
    request.camera = cameraAround(image, {1, 2, 3}, true);
    renderer.renderAll(requestOf("field", 16, 16, 2));
    const std::uint64_t before = device.allocatedBytes();
    render::Target one;
    const model::Frame frame = renderer.render(one, request, 0, 1);
    EXPECT_EQ(passNames(frame), (std::vector<std::string>{"glyph trace", "light"}));
    const std::uint64_t bytes = device.allocatedBytes() - before;
    EXPECT_LT(bytes, 40U * 640 * 480) << "28 bytes a pixel, and tile lists";
    EXPECT_THROW(renderer.render(one, request, 1, 1), Error);
    request.quality.samples = 2;
    render::Target two;
    const model::Frame first = renderer.render(two, request, 0, 1);
    EXPECT_EQ(passNames(first), (std::vector<std::string>{"glyph trace", "light", "resolve"}));
    EXPECT_GE(device.allocatedBytes() - before - bytes, 40U * 640 * 480);
    EXPECT_EQ(first.pixels.rgba, frame.pixels.rgba);
}

TEST_F(Cost, OfExactOutputsIsNothingWhereNoneIsWanted) {
    const model::ShImage image = randomField({2, false}, {2, 2, 2}, 62, obliqueAffine());
    store.add("field", image);
    model::FrameRequest request = requestOf("field", 640, 480, 2);
    request.camera = cameraAround(image, {1, 2, 3}, true);
    render::Target target;
    const model::Frame frame = renderer.render(target, request, 0, 1);
    EXPECT_TRUE(frame.pixels.depth.empty() && frame.pixels.id.empty() && frame.pixels.position.empty() &&
                frame.pixels.normal.empty() && frame.pixels.steps.empty());
    const std::uint64_t plain = device.allocatedBytes();
    model::Outputs depth;
    depth.depth = true;
    const model::Frame more = renderer.render(target, request, 0, 1, depth);
    EXPECT_EQ(more.pixels.depth.size(), 640U * 480U);
    EXPECT_TRUE(more.pixels.id.empty());
    EXPECT_GE(device.allocatedBytes(), plain + 640 * 480 * 24) << "the read-back buffer comes with the first wanted output";
    EXPECT_EQ(frame.pixels.rgba, more.pixels.rgba);
}

/// Asked for: 50 ms. The bound leaves 200 more for machines with other work on them; the time is printed.
TEST_F(Cost, OfAPictureThatNobodyWantsEndsSoon) {
    using Clock = std::chrono::steady_clock;
    const model::ShImage image = phantomImage(20, 8);
    store.add("brain", image);
    model::FrameRequest request = requestOf("brain", 2560, 1440, 1);
    request.scene.layers[0].glyphs().scale = {};
    request.camera = cameraAround(image, {1, 2, 3}, true);
    request.quality.samples = 64;
    render::Target target;
    renderer.render(target, request, 0, 1);  // pipelines are compiled and structures built
    double worst_ms = 0;
    for (const int wait_ms : {0, 150, 333}) {
        std::atomic<bool> cancel = false;
        Clock::time_point asked;
        std::thread other([&] {
            std::this_thread::sleep_for(std::chrono::milliseconds(wait_ms));
            asked = Clock::now();
            cancel = true;
        });
        const Code code = codeOf([&] { renderer.render(target, request, 0, 64, {}, &cancel); });
        const Clock::time_point ended = Clock::now();
        other.join();
        EXPECT_EQ(code, Code::kCancelled);
        worst_ms = std::max(worst_ms, std::chrono::duration<double, std::milli>(ended - asked).count());
    }
    std::printf("cancelled within %.1f ms\n", worst_ms);
    EXPECT_LE(worst_ms, 250);
    // The target is free for the next picture.
    request.quality.samples = 1;
    EXPECT_EQ(renderer.render(target, request, 0, 1).info.state, model::FrameState::kConverged);
}

class Validated : public ImageTest {
protected:
    Validated() : ImageTest(gpu::DeviceOptions{.device = {}, .validation = true, .pipeline_cache = {}, .without = {}}) {}
};

TEST_F(Validated, IsEveryWayToDraw) {
    const model::ShImage image = randomField({4, false}, {4, 3, 2}, 63, obliqueAffine());
    store.add("field", image);
    store.add("full", randomField({3, true}, {2, 2, 2}, 64, obliqueAffine()));
    model::FrameRequest request = requestOf("field", 72, 50, 2);
    request.camera = cameraAround(image, {1, 2, 3}, true);
    render::Target target;
    int frames = 0;
    const auto drawAll = [&] {
        std::optional<model::Frame> first;
        for (const model::Traversal traversal :
             {model::Traversal::kTiles, model::Traversal::kBvh, model::Traversal::kRayQuery}) {
            request.quality.traversal = traversal;
            request.quality.samples = 3;
            renderer.render(target, request, 0, 1, everything());
            const model::Frame frame = renderer.render(target, request, 1, 2);
            if (!first) first = frame;
            EXPECT_EQ(frame.pixels.rgba, first->pixels.rgba);
            EXPECT_GT(renderer.measureBoxes(target, request), 0);
            ++frames;
        }
    };
    for (const model::PoleTable table : {model::PoleTable::kOff, model::PoleTable::kOn}) {
        request.quality.pole_table = table;
        drawAll();
    }
    request.quality.intersection = model::Intersection::kPolynomial;
    for (const bool bracket : {true, false}) {
        request.quality.polynomial.bracket_stop = bracket;
        drawAll();
    }
    request.quality.intersection = model::Intersection::kMarch;
    request.scene.layers.push_back(request.scene.layers[0]);
    request.scene.layers[1].glyphs().dataset_id = "full";
    request.width = 31;  // another size in the same target
    drawAll();
    EXPECT_EQ(frames, 15);
    for (const std::string& message : device.takeValidationMessages()) ADD_FAILURE() << message;
}

}  // namespace
}  // namespace radiata::test
