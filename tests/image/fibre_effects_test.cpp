// Transparent fibres, smoothed edges, and fibres within an outline, against every segment of every pixel in double.
#include <cmath>
#include <map>
#include <set>
#include <string>

#include "image/fibre_scenes.h"
#include "image/fixture.h"
#include "model/outline.h"
#include "reference/fxaa.h"
#include "reference/shading.h"

namespace radiata::test {
namespace {

class FibreEffects : public ImageTest {
protected:
    void SetUp() override {
        set = randomTractogram(31, 50, 200, 0.4, 5);
        store.add("fibres", set);
        request = fibreRequest("fibres", 96, 72);
        request.camera.eye_mm = {40, 30, 50};
        request.camera.height_mm = 30;
        request.scene.light.irradiance = 0;
        request.scene.light.ambient = 1;
        request.scene.layers[0].tracts().colour.mode = model::FibreColourMode::kUniform;
        request.scene.layers[0].tracts().colour.uniform = glm::vec3(1);
    }

    double linearAt(const model::Frame& frame, std::size_t at) {
        return reference::linearFromSrgb(frame.pixels.rgba[4 * at] / 255.0);
    }

    /// Of each pixel, how many fibres cover it: each drawn alone and opaque.
    std::vector<int> layersOfPixels() {
        std::vector<int> counts(static_cast<std::size_t>(request.width * request.height), 0);
        model::FrameRequest alone = request;
        alone.scene.layers[0].opacity = 1;
        for (std::uint32_t f = 0; f < set.fibres(); ++f) {
            alone.scene.layers[0].tracts().shown.fibres = {f};
            const model::Frame frame = draw(alone);
            for (std::size_t at = 0; at < counts.size(); ++at) counts[at] += frame.pixels.id[4 * at] >= 0;
        }
        return counts;
    }

    model::FibletSet set;
    model::FrameRequest request;
};

/// White fibres of opacity a over black let through (1 - a)^n: n of them cover the pixel, at least, for one may cross itself.
/// Steps of 8 bits are the bound where none does, in nine of ten pixels.
TEST_F(FibreEffects, TransparentFibresCountOnceEach) {
    const std::vector<int> counts = layersOfPixels();
    request.scene.layers[0].opacity = 0.3F;
    const model::Frame frame = draw(request);
    int equal = 0, covered = 0, deep = 0;
    for (std::size_t at = 0; at < counts.size(); ++at) {
        const double expected = 1 - std::pow(0.7, counts[at]), shown = linearAt(frame, at);
        ASSERT_EQ(shown > 0, counts[at] > 0) << at;
        if (counts[at] == 0) continue;
        ++covered;
        deep += counts[at] >= 3;
        EXPECT_GT(shown, expected - 0.01);
        equal += std::abs(shown - expected) < 0.01;
    }
    EXPECT_GT(deep, 30);
    EXPECT_GT(equal, covered * 9 / 10);
}

/// Two colours: what is in front counts more. Exact pictures equal the composition of the fibres by their depths.
TEST_F(FibreEffects, TransparentFibresAreOrdered) {
    request.scene.layers[0].tracts().colour.mode = model::FibreColourMode::kFibre;
    std::map<std::uint32_t, model::Frame> alone;
    for (std::uint32_t f = 0; f < set.fibres(); ++f) {
        request.scene.layers[0].tracts().shown.fibres = {f};
        alone[f] = draw(request);
    }
    request.scene.layers[0].tracts().shown = {};
    request.scene.layers[0].opacity = 0.5F;
    const model::Frame frame = draw(request);
    int equal = 0, several = 0;
    for (std::size_t at = 0; at < frame.pixels.depth.size(); ++at) {
        std::map<double, glm::dvec3> by_depth;
        for (const auto& [fibre, one] : alone) {
            if (one.pixels.id[4 * at] < 0) continue;
            glm::dvec3 colour(0);
            for (std::size_t c = 0; c < 3; ++c)
                colour[static_cast<int>(c)] = reference::linearFromSrgb(one.pixels.rgba[4 * at + c] / 255.0);
            by_depth[static_cast<double>(one.pixels.depth[at])] = colour;
        }
        if (by_depth.size() < 2) continue;
        ++several;
        glm::dvec3 expected(0);
        double through = 1;
        for (const auto& [depth, colour] : by_depth) {
            expected += through * 0.5 * colour;
            through *= 0.5;
        }
        double off = 0;
        for (std::size_t c = 0; c < 3; ++c) {
            off = std::max(off, std::abs(expected[static_cast<int>(c)] -
                                         reference::linearFromSrgb(frame.pixels.rgba[4 * at + c] / 255.0)));
        }
        equal += off < 0.012;
    }
    EXPECT_GT(several, 150);
    EXPECT_GT(equal, several * 9 / 10);
}

/// However its samples are split over calls a picture at rest is the same; while it moves, transparency is right (1/100 in nine
/// of ten pixels), though not who is seen. Opaque scenes have none of the passes.
TEST_F(FibreEffects, TransparencyComesToRest) {
    const std::vector<int> counts = layersOfPixels();
    request.scene.layers[0].opacity = 0.3F;
    request.quality.samples = 3;
    const model::Frame whole = draw(request);
    render::Target target;
    const model::Frame moving = renderer.render(target, request, 0, 1);
    renderer.render(target, request, 1, 1);
    const model::Frame rested = renderer.render(target, request, 2, 1);
    EXPECT_EQ(whole.pixels.rgba, rested.pixels.rgba);
    EXPECT_NE(whole.pixels.rgba, moving.pixels.rgba);
    int equal = 0, covered = 0;
    for (std::size_t at = 0; at < counts.size(); ++at) {
        if (counts[at] == 0) continue;
        ++covered;
        equal += std::abs(linearAt(moving, at) - (1 - std::pow(0.7, counts[at]))) < 0.01;
    }
    EXPECT_GT(equal, covered * 8 / 10);
    const auto peels = [](const model::Frame& frame) {
        return std::ranges::count_if(frame.info.passes, [](const auto& pass) { return pass.name == "peel"; });
    };
    EXPECT_EQ(peels(whole), 1);
    request.scene.layers[0].opacity = 1;
    EXPECT_EQ(peels(draw(request)), 0);
}

/// Behind a transparent layer stands what is opaque, and before it nothing of the layer.
TEST_F(FibreEffects, TransparentFibresShareThePicture) {
    store.add("others", randomTractogram(32, 50, 200, 0.4, 5));
    request.scene.layers.push_back(request.scene.layers[0]);
    request.scene.layers[1].tracts().dataset_id = "others";
    request.scene.layers[1].tracts().colour.uniform = {0, 0, 1};
    request.scene.layers[0].tracts().colour.uniform = {1, 0, 0};
    request.scene.layers[0].opacity = 0.5F;
    const model::Frame both = draw(request);
    model::FrameRequest first = request, second = request;
    first.scene.layers.pop_back();
    first.scene.layers[0].opacity = 1;
    second.scene.layers.erase(second.scene.layers.begin());
    const model::Frame a = draw(first), b = draw(second);
    int behind = 0, before = 0;
    for (std::size_t at = 0; at < a.pixels.depth.size(); ++at) {
        const double depth_a = static_cast<double>(a.pixels.depth[at]) + a.info.depth_offset_mm;
        const double depth_b = static_cast<double>(b.pixels.depth[at]) + b.info.depth_offset_mm;
        if (!std::isfinite(std::min(depth_a, depth_b)) || std::abs(depth_a - depth_b) < 1e-3) continue;
        const double red = reference::linearFromSrgb(both.pixels.rgba[4 * at] / 255.0);
        const double blue = reference::linearFromSrgb(both.pixels.rgba[4 * at + 2] / 255.0);
        if (depth_b < depth_a) {
            ASSERT_EQ(red, 0);
            ASSERT_EQ(blue, 1);
            ++behind;
        } else if (std::isfinite(depth_b)) {
            ASSERT_GT(red, 0.49);
            ASSERT_NEAR(red + blue, 1, 0.02);
            ++before;
        }
    }
    EXPECT_GT(behind, 100);
    EXPECT_GT(before, 30);
}

/// Pictures of one sample equal the reference's to a step of 8 bits; of more they do not change.
TEST_F(FibreEffects, EdgesAreSmoothed) {
    const model::Frame plain = draw(request);
    request.quality.fxaa = true;
    const model::Frame smooth = draw(request);
    int changed = 0;
    for (int y = 0; y < request.height; ++y) {
        for (int x = 0; x < request.width; ++x) {
            const glm::dvec3 expected = reference::fxaaPixel(plain.pixels.rgba, request.width, request.height, x, y);
            const auto at = static_cast<std::size_t>(4 * (y * request.width + x));
            for (std::size_t c = 0; c < 3; ++c)
                ASSERT_NEAR(smooth.pixels.rgba[at + c], 255 * expected[static_cast<int>(c)], 1.01);
            changed += smooth.pixels.rgba[at] != plain.pixels.rgba[at];
        }
    }
    EXPECT_GT(changed, 300);
    EXPECT_EQ(smooth.pixels.id, plain.pixels.id);
    request.quality.samples = 4;
    const model::Frame rested = draw(request);
    request.quality.fxaa = false;
    EXPECT_EQ(draw(request).pixels.rgba, rested.pixels.rgba);
}

/// Where nobody reads the surface buffer, fibres are lit in the pass that resolves them: the same bytes, one pass less.
TEST_F(FibreEffects, AreLitAsTheyAreResolved) {
    request.scene.light = {};
    model::TractogramLayer& layer = request.scene.layers[0].tracts();
    layer.colour.mode = model::FibreColourMode::kDirection;
    const auto passes = [](const model::Frame& frame) {
        std::set<std::string> names;
        for (const model::PassTime& pass : frame.info.passes) names.insert(pass.name);
        return names;
    };
    const auto compare = [&](const std::string& what) {
        const model::Frame apart = draw(request), at_once = renderer.renderAll(request);
        EXPECT_TRUE(passes(apart).contains("light")) << what;
        EXPECT_TRUE(passes(at_once).contains("fiblet light")) << what;
        EXPECT_FALSE(passes(at_once).contains("light") || passes(at_once).contains("fiblet surface")) << what;
        EXPECT_EQ(at_once.pixels.rgba, apart.pixels.rgba) << what;
        EXPECT_EQ(at_once.info.hit_pixels, apart.info.hit_pixels) << what;
        EXPECT_GT(at_once.info.hit_pixels, 500) << what;
    };
    compare("lines");
    request.camera.perspective = true;
    compare("perspective");
    request.quality.fxaa = true;
    compare("smoothed");
    request.quality.fiblet_culling = model::FibletCulling::kTwoPhase;
    compare("culled");
    layer.selected.emplace().fibres = {1, 4, 9};
    compare("dimmed");
    layer.colour.mode = model::FibreColourMode::kFibre;
    layer.tube_radius_mm = 0.5F;
    compare("selected tubes");
    layer.selected.reset();
    layer.colour.mode = model::FibreColourMode::kDirection;
    compare("tubes");
    layer.colour.mode = model::FibreColourMode::kLength;
    compare("by length");
    request.quality.samples = 2;
    EXPECT_TRUE(passes(renderer.renderAll(request)).contains("light")) << "samples are summed up";
}

/// The next view takes the memory of one that ended, and nothing of its picture.
TEST_F(FibreEffects, TakeTheMemoryOfAnEndedView) {
    request.quality.fiblet_culling = model::FibletCulling::kTwoPhase;
    model::FrameRequest other = request;
    other.camera.eye_mm = {-30, 40, 20};
    render::Target target, fresh;
    const std::uint64_t before = device.allocatedBytes();
    renderer.render(target, other, 0, 1);
    const std::uint64_t taken = device.allocatedBytes() - before;
    target.forget();
    EXPECT_LT(device.allocatedBytes() - before, taken) << "lists and parameters go";
    const model::Frame next = renderer.render(target, request, 0, 1);
    EXPECT_EQ(device.allocatedBytes() - before, taken);
    const model::Frame expected = renderer.render(fresh, request, 0, 1);
    EXPECT_EQ(next.pixels.rgba, expected.pixels.rgba);
    EXPECT_EQ(next.info.fiblets_drawn, expected.info.fiblets_drawn) << "who was seen is forgotten";
    target.forget();
    request.width = 200;
    EXPECT_EQ(renderer.render(target, request, 0, 1).pixels.rgba, renderer.renderAll(request).pixels.rgba);
}

/// Fibres in a triangle, a box and a pixel: those of the ids there; through it those that any picture of them alone shows
/// there.
TEST_F(FibreEffects, AreFoundInOutlines) {
    const model::Frame frame = draw(request);
    std::map<std::uint32_t, model::Frame> alone;
    for (std::uint32_t f = 0; f < set.fibres(); ++f) {
        model::FrameRequest one = request;
        one.scene.layers[0].tracts().shown.fibres = {f};
        alone[f] = draw(one);
    }
    const std::vector<std::vector<glm::dvec2>> outlines = {{{20, 10}, {70, 25}, {35.5, 60.5}},
                                                           {{30, 20}, {60, 50}},
                                                           {{60, 50}, {30, 20}},
                                                           {{48.3, 36.9}},
                                                           {{-50, -50}, {500, -50}, {500, 500}, {-50, 500}},
                                                           {{-9, -9}, {-1, -1}}};
    for (const auto& outline : outlines) {
        // By the sum of the angles that the outline's sides are seen under.
        const auto inside = [&](int x, int y) {
            const glm::dvec2 p(x + 0.5, y + 0.5);
            if (outline.size() == 1) return glm::floor(outline[0]) == glm::floor(p);
            if (outline.size() == 2) {
                const glm::dvec2 low = glm::min(outline[0], outline[1]), high = glm::max(outline[0], outline[1]);
                return glm::all(glm::lessThan(low, p)) && glm::all(glm::lessThan(p, high));
            }
            double sum = 0;
            for (std::size_t i = 0; i < outline.size(); ++i) {
                const glm::dvec2 a = outline[i] - p, b = outline[(i + 1) % outline.size()] - p;
                sum += std::atan2(a.x * b.y - a.y * b.x, glm::dot(a, b));
            }
            return std::abs(sum) > 3;
        };
        std::set<std::uint32_t> seen, through;
        for (int y = 0; y < request.height; ++y) {
            for (int x = 0; x < request.width; ++x) {
                if (!inside(x, y)) continue;
                const auto at = static_cast<std::size_t>(4 * (y * request.width + x));
                if (frame.pixels.id[at] >= 0) seen.insert(static_cast<std::uint32_t>(frame.pixels.id[at + 1]));
                for (const auto& [fibre, one] : alone) {
                    if (one.pixels.id[at] >= 0) through.insert(fibre);
                }
            }
        }
        const auto found = renderer.pickFibres(request, outline, false);
        ASSERT_EQ(found.size(), 1);
        EXPECT_EQ(found[0].dataset_id, "fibres");
        EXPECT_EQ(std::set(found[0].fibres.begin(), found[0].fibres.end()), seen);
        const auto all = renderer.pickFibres(request, outline, true);
        EXPECT_EQ(std::set(all[0].fibres.begin(), all[0].fibres.end()), through);
        EXPECT_GE(all[0].fibres.size(), found[0].fibres.size());
    }
    EXPECT_EQ(codeOf([&] { renderer.pickFibres(request, {}, false); }), Code::kInvalidArgument);
    EXPECT_EQ(codeOf([&] { renderer.pickFibres(request, std::vector<glm::dvec2>{{NAN, 0}}, false); }), Code::kInvalidArgument);
}

}  // namespace
}  // namespace radiata::test
